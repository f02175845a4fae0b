#include "runner/tables/components.hpp"

#include <string>

#include "runner/tables/component_names.hpp"

namespace grainsweep {
namespace {

std::int64_t sum_of(const std::array<std::int64_t, 3>& numbers) {
  return numbers[0] + numbers[1] + numbers[2];
}

/// Force-bearing contacts of a packing's slab, each once.
double contacts_of(const std::vector<ComponentMeasure>& components) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < components.size(); ++k) {
    for (std::size_t other = k; other < components.size(); ++other) {
      sum += sum_of(components[k].contacts[other]);
    }
  }
  return static_cast<double>(sum);
}

/// The share of those contacts that joins two components, and the share of each kind among these. A
/// packing without any is left out of the means.
void set_contacts(const Group& group, std::size_t k, std::size_t other, ComponentLine& line) {
  std::vector<double> shares;
  std::array<std::vector<double>, 3> kinds;
  for (const Outcome& outcome : group.settled) {
    const std::vector<ComponentMeasure>& all = outcome.result.components;
    if (k >= all.size() || other >= all[k].contacts.size()) continue;
    const std::array<std::int64_t, 3>& some = all[k].contacts[other];
    const double whole = contacts_of(all), joining = static_cast<double>(sum_of(some));
    shares.push_back(joining / whole);  // 0 / 0 is NaN
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
      kinds[kind].push_back(static_cast<double>(some[kind]) / joining);
    }
  }
  line.contacts = spread_of(shares);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    line.contact_kinds[kind] = spread_of(kinds[kind]);
  }
}

ComponentLine line_of(const Group& group, std::size_t k, std::size_t other) {
  using Measure = ComponentMeasure;
  const auto mean = [&](auto value) {
    return spread_of_entry(group, k, &PackingResult::components, value);
  };
  ComponentLine line;
  line.component = k + 1;
  line.other = other + 1;
  line.grains = mean(&Measure::grains);
  line.packed = mean(&Measure::packed);
  line.slab_share = mean(&Measure::slab_share);
  line.solid_fraction = mean(&Measure::solid_fraction);
  line.coordination = mean(&Measure::coordination);
  line.coordination_with_walls = mean(&Measure::coordination_with_walls);
  for (std::size_t axis = 0; axis < line.nematic.size(); ++axis) {
    line.nematic[axis] = mean([=](const Measure& one) { return one.nematic[axis]; });
  }
  line.neighbours = mean([=](const Measure& one) { return one.neighbours.at(other); });
  set_contacts(group, k, other, line);
  return line;
}

struct GroupComponentLine {
  const Group& group;
  ComponentLine line;
};

Columns<GroupComponentLine> component_line_columns(const Varied& varied, const GivenUnits& units) {
  using Line = GroupComponentLine;
  Columns<Line> columns = columns_of_group<Line>(varied);
  append(
      columns,
      Columns<Line>{{"component", "", "its number in shape.mixture, from 1",
                     [](const Line& line) { return cell(line.line.component); }},
                    {"component_shape", "", component_shape_meaning,
                     [](const Line& line) { return cell(line.line.name); }},
                    {"other", "", "the number of a component, its own among them",
                     [](const Line& line) { return cell(line.line.other); }},
                    {"other_shape", "", other_shape_meaning,
                     [](const Line& line) { return cell(line.line.other_name); }},
                    {"n", "",
                     "packings that enter the means; a mean of what some of them lack, as "
                     "kinds of contact where grains of the two do not touch, comes from the others",
                     [](const Line& line) { return cell(line.line.grains.n); }}});
  const auto add = [&](const char* name, const char* meaning, Spread ComponentLine::*spread) {
    append_spread(columns, name, "", meaning, [=](const Line& line) { return line.line.*spread; });
  };
  add("neighbours",
      "grains of the other component that one of the component touches, with its centre "
      "in the slab, at gap_tolerance",
      &ComponentLine::neighbours);
  add("contacts", "share of the slab's force-bearing contacts between grains that join the two",
      &ComponentLine::contacts);
  const std::array kinds = {"contacts_simple", "contacts_double", "contacts_triple"};
  const std::array places = {"share of those at a point", "along a line", "over an area"};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    append_spread(columns, kinds[kind], "", places[kind],
                  [=](const Line& line) { return line.line.contact_kinds[kind]; });
  }
  add("grains", "of the component in the whole bed; all that follows is of the component alone",
      &ComponentLine::grains);
  add("packed", "its share of the solid volume of the whole bed", &ComponentLine::packed);
  add("slab", "its share of the solid volume in the slab", &ComponentLine::slab_share);
  add("solid_fraction", "its exact solid volume in the slab over the slab's volume",
      &ComponentLine::solid_fraction);
  add("coordination", "touching grains of any component per grain of its own",
      &ComponentLine::coordination);
  add("coordination_with_walls", "the same, walls and floor counted",
      &ComponentLine::coordination_with_walls);
  const std::array names = {"nematic_x", "nematic_y", "nematic_z"};
  for (std::size_t axis = 0; axis < names.size(); ++axis) {
    append_spread(columns, names[axis], "",
                  std::string("nematic order of the axis ") + names[axis][8] + " of its frame",
                  [=](const Line& line) { return line.line.nematic[axis]; });
  }
  append_in_units_of_component(columns, units);
  return columns;
}

}  // namespace

std::size_t components_of(const Group& group) {
  return group.settled.empty() ? 0 : group.settled.front().get().result.components.size();
}

std::vector<ComponentLine> mean_components(const Group& group) {
  std::vector<ComponentLine> lines;
  const std::size_t components = components_of(group);
  std::vector<std::string> names = component_names(group.job);
  names.resize(components);  // journals are not checked against the sweep
  for (std::size_t k = 0; k < components; ++k) {
    for (std::size_t other = 0; other < components; ++other) {
      ComponentLine& line = lines.emplace_back(line_of(group, k, other));
      line.name = names[k];
      line.other_name = names[other];
    }
  }
  return lines;
}

CurveTable components_table(const Varied& varied, const GivenUnits& units) {
  const auto columns = component_line_columns(varied, units);
  return curve_table("components.csv", columns, [](const Group& group) {
    std::vector<GroupComponentLine> lines;
    for (const ComponentLine& line : mean_components(group)) lines.push_back({group, line});
    return lines;
  });
}

}  // namespace grainsweep
