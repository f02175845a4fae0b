#include "runner/report/bed_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "runner/export/exported_bed.hpp"
#include "runner/export/surfaces.hpp"
#include "runner/report/axes.hpp"
#include "runner/report/html.hpp"
#include "runner/report/picture.hpp"
#include "runner/report/templates.hpp"
#include "runner/tables/component_names.hpp"
#include "runner/tables/csv.hpp"

namespace grainsweep {
namespace {

constexpr double largest_unsigned = 65535.0, largest_signed = 32767.0;

/// Appends a number of two bytes, the lower one first.
void append_short(std::string& bytes, long number) {
  const auto bits = static_cast<std::uint16_t>(number);
  bytes += static_cast<char>(bits & 0xFFu);
  bytes += static_cast<char>(bits >> 8u);
}

/// Appends `value(grain)` of every grain, as shares of `unit`.
template <class Value>
void append_column(std::string& bytes, const StoredBed& bed, double unit, Value value) {
  for (const SettledGrain& grain : bed.grains) {
    const double share = unit > 0.0 ? std::clamp(value(grain) / unit, 0.0, 1.0) : 0.0;
    append_short(bytes, std::lround(largest_unsigned * share));
  }
}

template <class Value>
double largest(const StoredBed& bed, Value value) {
  double most = 0.0;
  for (const SettledGrain& grain : bed.grains) most = std::max(most, value(grain));
  return most;
}

/// Columns of all grains, one behind the other, as templates/bed.js reads them.
std::string columns_of(const StoredBed& bed, double extent, double radius, double force) {
  std::string bytes;
  append_column(bytes, bed, extent, [](const SettledGrain& grain) { return grain.x; });
  append_column(bytes, bed, extent, [](const SettledGrain& grain) { return grain.y; });
  append_column(bytes, bed, extent, [](const SettledGrain& grain) { return grain.z; });
  append_column(bytes, bed, radius, [](const SettledGrain& grain) { return grain.radius; });
  append_column(bytes, bed, force, [](const SettledGrain& grain) { return grain.force; });
  for (const SettledGrain& grain : bed.grains) append_short(bytes, grain.touching);
  if (!bed.turned) return bytes;
  for (const auto& turn : bed.turned->orientations) {
    for (const double part : turn) append_short(bytes, std::lround(largest_signed * part));
  }
  for (const std::uint8_t component : bed.turned->components) append_short(bytes, component);
  return bytes;
}

void append_word(std::string& bytes, std::int32_t number) {
  append_short(bytes, number & 0xFFFF);
  append_short(bytes, number >> 16);
}

/// Both grains of each force, and the forces as shares of the largest, as templates/bed.js reads
/// them.
std::string forces_of(const StoredBed& bed, double largest_force) {
  std::string bytes;
  for (const PairForce& force : bed.forces) append_word(bytes, force.a);
  for (const PairForce& force : bed.forces) append_word(bytes, force.b);
  for (const PairForce& force : bed.forces) {
    append_short(bytes, std::lround(largest_unsigned * force.magnitude / largest_force));
  }
  return bytes;
}

std::string css_colour(const Colour& colour) {
  return "rgb(" + cell(colour[0]) + "," + cell(colour[1]) + "," + cell(colour[2]) + ")";
}

/// A square of this colour, before its name.
std::string square_of(const Colour& colour) {
  return "<span class=\"scale square\" style=\"background:" + css_colour(colour) + "\"></span>";
}

std::string diameter_text(const SettledGrain& grain, const BedFacts& facts) {
  const double d = facts.units ? facts.units->d : 1.0;
  return short_number(2.0 * grain.radius * d) + " " +
         (facts.units ? html_text(printed_unit(*facts.units)) : "d");
}

}  // namespace

std::string bed_element(const StoredBed& bed, const BedFacts& facts) {
  const double radius = largest(bed, [](const SettledGrain& grain) { return grain.radius; });
  const double force = largest(bed, [](const SettledGrain& grain) { return grain.force; });
  const double height =
      largest(bed, [](const SettledGrain& grain) { return grain.z + grain.radius; });
  double pair_force = 0.0;
  for (const PairForce& one : bed.forces) {
    pair_force = std::max(pair_force, one.magnitude);
  }
  const double extent = std::max({bed.box.length, bed.box.width, height});
  nlohmann::json json = {{"count", bed.grains.size()},
                         {"extent", extent},
                         {"largest_radius", radius},
                         {"largest_force", force},
                         {"small_limit", facts.small_limit},
                         {"unit", facts.units ? printed_unit(*facts.units) : "d"},
                         {"d", facts.units ? facts.units->d : 1.0},
                         {"grains", base64(columns_of(bed, extent, radius, force))},
                         {"pairs", bed.forces.size()},
                         {"largest_pair_force", pair_force},
                         {"forces", base64(forces_of(bed, pair_force))}};
  json["box"] = nlohmann::json::array({bed.box.length, bed.box.width, height});
  json["walls"] =
      nlohmann::json::array({bed.box.x == Boundary::walls, bed.box.y == Boundary::walls});
  json["tube"] = bed.box.is_tube;
  json["components"] = facts.components;
  if (bed.turned) {
    for (const Mesh& mesh : bed.turned->meshes) {
      const Mesh drawn = drawn_mesh(mesh, 1);  // 80 triangles of a sphere
      json["meshes"].push_back(
          {{"vertices", drawn.vertices}, {"faces", drawn.faces}, {"is_ball", mesh.is_ball()}});
    }
  }
  return "<script type=\"application/json\" class=\"bed-data\" data-title=\"" +
         html_text(facts.title) + "\">" + json_in_script(json.dump()) + "</script>\n";
}

std::size_t view_size(const StoredBed& bed) {
  const std::size_t bytes = !bed.turned ? 12 : bed.turned->components.empty() ? 20 : 22;
  return (bed.grains.size() * bytes + bed.forces.size() * 10) * 4 / 3;
}

std::string picture_key(const StoredBed& bed, const BedFacts& facts) {
  std::string key;
  if (has_components(bed)) {
    for (std::size_t k = 0; k < facts.components.size(); ++k) {
      key += square_of(component_colour(k)) + html_text(facts.components[k]) + " ";
    }
    return key;
  }
  const auto [smallest, largest] = std::minmax_element(
      bed.grains.begin(), bed.grains.end(),
      [](const SettledGrain& a, const SettledGrain& b) { return a.radius < b.radius; });
  if (smallest == largest) return "";
  const std::string low = diameter_text(*smallest, facts), high = diameter_text(*largest, facts);
  if (smallest->radius == largest->radius) return square_of(colour_of_one_size()) + "all " + low;
  for (const Colour& colour : size_colours()) key += (key.empty() ? "" : ",") + css_colour(colour);
  return low + "<span class=\"scale\" style=\"background:linear-gradient(to right," + key +
         ")\"></span>" + high;
}

std::string bed_section(const BedView& view) {
  std::string data;
  for (const std::string& bed : view.beds) data += bed;
  const std::string left_out = view.beds.size() < view.all
                                   ? " Beds of " + cell(view.beds.size()) + " of " +
                                         cell(view.all) + " parameter sets are here."
                                   : "";
  return filled(templates::bed_html, {{"title", html_text(view.title)},
                                      {"picture", data_uri("image/png", view.picture)},
                                      {"key", view.key},
                                      {"left_out", left_out},
                                      {"data", data}});
}

std::string bed_page(const StoredBed& bed, const BedFacts& facts) {
  const std::string picture = picture_of(bed, picture_width, picture_height);
  return filled(
      templates::view_html,
      {{"head", html_head(facts.title)},
       {"title", html_text(facts.title)},
       {"bed",
        bed_section({facts.title, picture, picture_key(bed, facts), {bed_element(bed, facts)}})},
       {"scripts", bed_scripts()}});
}

std::string bed_scripts() {
  return "<script>" + std::string(templates::three_min_js) + "</script>\n<script>" +
         std::string(templates::repeat_js) + std::string(templates::forces_js) +
         std::string(templates::bed_js) + "</script>\n";
}

BedFacts facts_of(const JobFacts& job, const std::string& title) {
  const double limit = small_class_limit(job);
  return {title, std::isfinite(limit) ? limit : 0.0, {}, component_names(job)};
}

}  // namespace grainsweep
