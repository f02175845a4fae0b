#include "runner/tables/component_profiles.hpp"

#include <string>

#include "runner/tables/component_names.hpp"
#include "runner/tables/components.hpp"
#include "runner/tables/profiles.hpp"

namespace grainsweep {
namespace {

using ComponentBins = std::vector<const ComponentBin*>;

/// NaN without grains.
double per_component_grain(std::int64_t count, const ComponentBin& bin) {
  return static_cast<double>(count) / static_cast<double>(bin.grains);
}

std::int64_t all_neighbours(const ComponentBin& bin) {
  std::int64_t sum = 0;
  for (const std::int64_t some : bin.neighbours) sum += some;
  return sum;
}

MeanComponentBin mean_component_bin(const ComponentBins& bins, std::size_t other, double low,
                                    double high) {
  using Bin = const ComponentBin&;
  MeanComponentBin mean;
  mean.low = low;
  mean.high = high;
  mean.solid_fraction = spread_of_each(bins, [](Bin bin) { return bin.solid_fraction; });
  mean.neighbours = spread_of_each(
      bins, [=](Bin bin) { return per_component_grain(bin.neighbours.at(other), bin); });
  mean.coordination =
      spread_of_each(bins, [](Bin bin) { return per_component_grain(all_neighbours(bin), bin); });
  mean.coordination_with_walls = spread_of_each(
      bins, [](Bin bin) { return per_component_grain(all_neighbours(bin) + bin.walls, bin); });
  for (std::size_t axis = 0; axis < mean.nematic.size(); ++axis) {
    mean.nematic[axis] = spread_of_each(bins, [=](Bin bin) { return bin.nematic[axis]; });
  }
  return mean;
}

/// The profiles of component `k` that a group's packings have.
std::vector<const ComponentProfile*> component_profiles_of(
    const Group& group, ComponentProfile ComponentMeasure::*profile, std::size_t k) {
  std::vector<const ComponentProfile*> profiles;
  for (const Outcome& outcome : group.settled) {
    const std::vector<ComponentMeasure>& all = outcome.result.components;
    if (k < all.size()) profiles.push_back(&(all[k].*profile));
  }
  return profiles;
}

struct ComponentProfileLine {
  const Group& group;
  const char* axis = "";
  std::size_t component = 0, other = 0;  ///< from 1
  std::string name, other_name;
  MeanComponentBin bin;
};

Columns<ComponentProfileLine> component_profile_columns(const Varied& varied,
                                                        const GivenUnits& units) {
  using In = const ComponentProfileLine&;
  Columns<ComponentProfileLine> columns = columns_of_group<ComponentProfileLine>(varied);
  append(
      columns,
      Columns<ComponentProfileLine>{
          {"axis", "", profile_axis_meaning, [](In line) { return cell(line.axis); }},
          {"component", "", "its number in shape.mixture, from 1",
           [](In line) { return cell(line.component); }},
          {"component_shape", "", component_shape_meaning, [](In line) { return cell(line.name); }},
          {"other", "", "the number of a component, its own among them",
           [](In line) { return cell(line.other); }},
          {"other_shape", "", other_shape_meaning, [](In line) { return cell(line.other_name); }},
          {"low", "d", "where the bin begins", [](In line) { return short_cell(line.bin.low); }},
          {"high", "d", "where it ends", [](In line) { return short_cell(line.bin.high); }},
          {"from_axis", "d", "distance of its middle from the axis of a tube; empty elsewhere",
           [](In line) {
             return short_cell(from_axis(line.group, line.axis, line.bin.low, line.bin.high));
           }},
          {"n", "", "packings, those among them that end below the bin",
           [](In line) { return cell(line.bin.solid_fraction.n); }},
          {"coordination_n", "",
           "those of them with grains of the component whose centre is in the bin",
           [](In line) { return cell(line.bin.coordination.n); }}});
  const auto add = [&](const std::string& name, const std::string& meaning,
                       Spread MeanComponentBin::*spread) {
    append_spread(columns, name, "", meaning, [=](In line) { return line.bin.*spread; });
  };
  add("neighbours",
      "grains of the other component that one of the component touches, its centre in the bin",
      &MeanComponentBin::neighbours);
  add("solid_fraction",
      "solid volume of the component over the bin's volume; this and all that follows is of the "
      "component alone",
      &MeanComponentBin::solid_fraction);
  add("coordination", "touching grains of any component per grain of its own",
      &MeanComponentBin::coordination);
  add("coordination_with_walls", "the same, walls and floor counted",
      &MeanComponentBin::coordination_with_walls);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const char letter = "xyz"[axis];
    append_spread(columns, std::string("nematic_") + letter, "",
                  std::string("nematic order of the axis ") + letter +
                      " of its frame; of a single grain 1, of a few far above that of many",
                  [=](In line) { return line.bin.nematic[axis]; });
  }
  append_in_units_of_component(columns, units);
  return columns;
}

void append_component_bins(const Group& group, const char* axis,
                           ComponentProfile ComponentMeasure::*profile,
                           std::vector<ComponentProfileLine>& lines) {
  const std::size_t components = components_of(group);
  std::vector<std::string> names = component_names(group.job);
  names.resize(components);  // journals are not checked against the sweep
  for (std::size_t k = 0; k < components; ++k) {
    for (std::size_t other = 0; other < components; ++other) {
      for (const MeanComponentBin& bin : mean_component_profile(group, profile, k, other)) {
        lines.push_back({group, axis, k + 1, other + 1, names[k], names[other], bin});
      }
    }
  }
}

}  // namespace

std::vector<MeanComponentBin> mean_component_profile(const Group& group,
                                                     ComponentProfile ComponentMeasure::*profile,
                                                     std::size_t k, std::size_t other) {
  ComponentBin beyond;
  beyond.neighbours.resize(components_of(group));
  beyond.nematic.fill(no_number);
  return mean_bins(component_profiles_of(group, profile, k), beyond,
                   [other](const ComponentBins& bins, double low, double high) {
                     return mean_component_bin(bins, other, low, high);
                   });
}

CurveTable component_profiles_table(const Varied& varied, const GivenUnits& units) {
  const auto columns = component_profile_columns(varied, units);
  return curve_table("component_profiles.csv", columns, [](const Group& group) {
    using Measure = ComponentMeasure;
    std::vector<ComponentProfileLine> lines;
    append_component_bins(group, "x", &Measure::profile_x, lines);
    append_component_bins(group, "y", &Measure::profile_y, lines);
    append_component_bins(group, "walls", &Measure::profile_from_walls, lines);
    append_component_bins(group, "z", &Measure::profile_z, lines);
    return lines;
  });
}

}  // namespace grainsweep
