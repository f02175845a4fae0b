#include "runner/sweep/given_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "engine/text.hpp"
#include "runner/hash.hpp"
#include "runner/sweep/mixture_components.hpp"
#include "runner/sweep/parameter_row.hpp"
#include "runner/sweep/size_formulas.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/sweep/values.hpp"

namespace grainsweep {

namespace {

/// Grains from fill files over all jobs, each of which keeps its own copy: 1.6 GB.
constexpr std::uint64_t most_placed_grains = 50'000'000;

/// Vertices of hulls over all jobs, likewise, 1.2 GB.
constexpr std::uint64_t most_vertices = 50'000'000;

Points points_of(const VerticesReading& reading) {
  Points points;
  points.reserve(reading.vertices.size());
  for (const Vector& vertex : reading.vertices) {
    points.push_back({vertex.x(), vertex.y(), vertex.z()});
  }
  return points;
}

/// The points in units of `size`, a length in their present unit.
Points scaled_points(Points points, double size) {
  for (auto& point : points) {
    for (double& coordinate : point) coordinate = coordinate / size + 0.0;  // -0 and 0 are one
  }
  return points;
}

/// Hash of the grains themselves, however a file writes them: of q and -q, which are one
/// orientation, it takes that whose first number that is not zero is positive.
std::uint64_t hash_of(PlacedGrains placed) {
  for (auto& q : placed.orientations) {
    const auto first = std::find_if(q.begin(), q.end(), [](double part) { return part != 0.0; });
    if (first == q.end() || *first > 0.0) continue;
    for (double& part : q) part = 0.0 - part;
  }
  const auto bytes_of = [](const auto& list) {
    return std::string_view(reinterpret_cast<const char*>(list.data()),
                            list.size() * sizeof list.front());
  };
  return mixed(fnv1a(bytes_of(placed.grains)) + mixed(fnv1a(bytes_of(placed.orientations)))) ^
         fnv1a(bytes_of(placed.components));
}

/// The sizes of two classes that hold the small grains of a file: `{"small_share": 0.3,
/// "size_ratio": 0.6}`.
std::string classes_text(const GrainsReading& reading, double diameter) {
  double small = 0.0, all = 0.0, sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < reading.grains.size(); ++k) {
    const double radius = reading.grains[k].radius, volume = std::pow(radius, 3);
    all += volume;
    if (!reading.are_small[k]) continue;
    small += volume;
    sum += 2.0 * radius;
    count += 1.0;
  }
  const auto rounded = [](double value) {
    constexpr double unit = 1e-3;
    return bound_text(std::max(1.0, std::round(value / unit)) / 1e3);
  };
  return R"({"small_share": )" + rounded(small / all) + R"(, "size_ratio": )" +
         rounded(sum / count / diameter) + "}";
}

/// Whether these are diameters of a distribution that somebody chose: defaults are in d.
bool is_chosen_diameter(const Assignment* assignment) {
  if (assignment == nullptr) return false;
  const Parameter& parameter = parameters()[assignment->parameter];
  return parameter.is_diameter && assignment->value != default_of(parameter);
}

}  // namespace

std::vector<GivenStart> GivenFiles::starts(const Block& block, const InEffect& in_effect,
                                           ResolvedSpec& resolved) {
  const Assignment *diameter = in_effect[diameter_], *file = in_effect[file_];
  const Assignment* const files = in_effect[files_];
  if (file == nullptr && files == nullptr) {
    note_stray(diameter, "belongs to fill.file or fill.files; neither is set");
    return {{resolved.spec.fill}};
  }
  if (!(resolved.fill_diameter > 0.0)) {
    said_.problem(*diameter, "must be positive");
    return {{SolidHeight{}}};
  }
  if (diameter != nullptr) {
    note_other_length(diameter->pointer, resolved.fill_diameter,
                      files != nullptr ? "the files are" : "the file is");
  }
  if (files != nullptr) return starts_in_list(block, *files, resolved);
  GivenStart start = start_in(resolved.fill_file, *file, resolved);
  resolved.fill_content = start.content;
  if (block.replicates.most > 1 && !start.content.empty()) {
    said_.problem(*file,
                  "would give all " + std::to_string(block.replicates.most) +
                      " replicates the same start; write \"replicates\": 1, or list a start for "
                      "each in fill.files");
  }
  return {std::move(start)};
}

std::vector<GivenStart> GivenFiles::starts_in_list(const Block& block, const Assignment& files,
                                                   const ResolvedSpec& resolved) {
  std::vector<GivenStart> starts;
  std::map<std::uint64_t, std::string> file_of;  // by what it says, however it is written
  for (const std::string& file : resolved.fill_files) {
    const Assignment entry{files.parameter, file,
                           files.pointer + "/" + std::to_string(starts.size())};
    starts.push_back(start_in(file, entry, resolved));
    starts.back().pointer = entry.pointer;
    const auto* placed = std::get_if<PlacedGrains>(&starts.back().fill);
    if (placed == nullptr) continue;
    const auto [same, is_new] = file_of.try_emplace(hash_of(*placed), file);
    if (!is_new) {
      said_.problem(entry, "is the same start as " + same->second + "; replicates must differ");
    }
  }
  if (block.replicates.most > 1 &&
      static_cast<std::size_t>(block.replicates.most) != starts.size()) {
    said_.problem(files, "lists " + std::to_string(starts.size()) + " starts for " +
                             std::to_string(block.replicates.most) +
                             " replicates; write \"replicates\": " + std::to_string(starts.size()));
  }
  return starts;
}

GivenStart GivenFiles::start_in(const std::string& file, const Assignment& assignment,
                                const ResolvedSpec& resolved) {
  GivenStart start{SolidHeight{}, file, "", ""};
  const GrainsReading& reading = reading_of(file, assignment, read_grains, grains_);
  if (!reading.errors.empty()) return start;
  placed_ += reading.grains.size();
  if (placed_ > most_placed_grains) {
    said_.problem(assignment, "the jobs hold more than " + in_thousands(most_placed_grains) +
                                  " grains from files together; split the sweep");
    return start;
  }
  start.fill = PlacedGrains{scaled_grains(reading.grains, resolved.fill_diameter),
                            reading.orientations, reading.components};
  note_classes(assignment, reading, resolved);
  start.content = reading.content;
  return start;
}

void GivenFiles::place(const Block& block, const InEffect& in_effect, ResolvedSpec& resolved) {
  place_vertices(block, in_effect, resolved);
  place_components(block, in_effect, resolved);
  place_sizes(in_effect, resolved);
}

void GivenFiles::place_vertices(const Block& block, const InEffect& in_effect,
                                ResolvedSpec& resolved) {
  const Assignment* size = in_effect[hull_size_];
  const Assignment* file = in_effect[hull_file_];
  const Assignment* vertices = in_effect[hull_vertices_];
  const Assignment* source = file != nullptr ? file : vertices;
  if (file != nullptr && vertices != nullptr) {  // reported already
    for (const Assignment* one : {file, vertices}) problems_.skip(one->pointer + " shape.hull");
    return;
  }
  if (source == nullptr) {
    return note_stray(size, "belongs to shape.hull.vertices or shape.hull.file; neither is set");
  }
  if (!std::holds_alternative<HullVertices>(resolved.spec.shape)) return;  // reported already
  auto& hull = std::get<HullVertices>(resolved.spec.shape);
  bool is_sound = true;
  if (file != nullptr) {
    const VerticesReading& reading = reading_of(resolved.hull_file, *file, read_vertices, hulls_);
    is_sound = reading.errors.empty();
    hull.points = points_of(reading);
    note_hull(*file, reading);
  }
  if (!(resolved.hull_size > 0.0)) {
    said_.problem(*size, "must be positive");
    is_sound = false;
  } else if (size != nullptr) {
    note_other_length(size->pointer, resolved.hull_size,
                      file != nullptr ? "the file is" : "the vertices are");
  }
  is_sound = has_room(hull.points.size(), block, *source) && is_sound;
  hull.points = is_sound ? scaled_points(std::move(hull.points), resolved.hull_size) : Points{};
  if (!is_sound) problems_.skip(source->pointer + " shape.hull");
}

void GivenFiles::place_components(const Block& block, const InEffect& in_effect,
                                  ResolvedSpec& resolved) {
  const Assignment* mixture = in_effect[mixture_];
  if (mixture == nullptr) {
    return note_stray(in_effect[mixture_by_], "belongs to shape.mixture, and that is not set");
  }
  auto components = std::get<Components>(mixture->value);
  bool is_sound = true, has_hulls = false;
  for (std::size_t k = 0; k < components.size(); ++k) {
    if (!std::holds_alternative<HullVertices>(components[k].shape)) continue;
    has_hulls = true;
    const std::string place = mixture->pointer + "/" + std::to_string(k) + "/hull/";
    const bool in_file = !components[k].hull_file.empty();
    const Assignment source{mixture->parameter, components[k].hull_file,
                            place + (in_file ? "file" : "vertices")};
    is_sound = place_component(block, source, components[k]) && is_sound;
    note_other_length(place + "size", components[k].hull_size,
                      in_file ? "the file is" : "the vertices are");
  }
  if (!has_hulls) return;
  parameters()[mixture_].set(resolved, components);
  if (is_sound) return;
  problems_.skip(mixture->pointer + " shape.mixture");
  problems_.skip(block.pointer + " shape.hull");
}

bool GivenFiles::place_component(const Block& block, const Assignment& source,
                                 WrittenComponent& component) {
  Points points = std::get<HullVertices>(component.shape).points;
  bool is_sound = true;
  if (!component.hull_file.empty()) {
    const VerticesReading& reading = reading_of(component.hull_file, source, read_vertices, hulls_);
    is_sound = reading.errors.empty();
    points = points_of(reading);
    note_hull(source, reading);
  }
  is_sound = has_room(points.size(), block, source) && is_sound;
  place_hull(is_sound ? scaled_points(std::move(points), component.hull_size) : Points{},
             component);
  return is_sound;
}

void GivenFiles::place_sizes(const InEffect& in_effect, ResolvedSpec& resolved) {
  auto& distribution = resolved.spec.sizes.distribution;
  const Assignment *file = in_effect[size_file_], *size = in_effect[size_unit_];
  if (!resolved.has_size_formula) {
    for (const Assignment* part : in_effect) {
      if (part == nullptr || parameters()[part->parameter].role != Role::distribution) continue;
      note_stray(part, "belongs to a distribution of sizes, and none is set: write " +
                           size_formula_names(", ", " or "));
    }
    return distribution.reset();
  }
  if (file != nullptr) {
    const SizesReading& reading = reading_of(resolved.size_file, *file, read_sizes, sizes_);
    if (!reading.errors.empty()) return distribution.reset();
    distribution->formula = reading.table;
  }
  if (size == nullptr) note_unit_of(in_effect);
  if (!(resolved.size_unit > 0.0)) {
    said_.problem(*size, "must be positive");
    return distribution.reset();
  }
  if (size != nullptr) {
    note_other_d(size->pointer, resolved.size_unit, "the diameters are", "others");
  }
  to_units_of(resolved.size_unit, *distribution);
}

void GivenFiles::note_classes(const Assignment& assignment, const GrainsReading& reading,
                              const ResolvedSpec& resolved) {
  const auto& small = reading.are_small;
  if (resolved.spec.sizes.small_share > 0.0 || resolved.has_size_formula) return;
  if (std::find(small.begin(), small.end(), true) == small.end()) return;
  said_.remark(
      assignment.pointer, "classes",
      "calls grains small in its column size_class that count as large, as sizes.small_share is "
      "0; to tell them apart write \"sizes\": " +
          classes_text(reading, resolved.fill_diameter));
}

void GivenFiles::note_hull(const Assignment& file, const VerticesReading& reading) {
  if (!reading.note.empty()) said_.remark(file.pointer, "hull", reading.note);
}

void GivenFiles::note_unit_of(const InEffect& in_effect) {
  const GivenUnits& units = definition_.units;
  if (!units || units->d == 1.0 || has_noted_unit_) return;
  const auto length = std::find_if(in_effect.begin(), in_effect.end(), is_chosen_diameter);
  if (length == in_effect.end()) return;
  has_noted_unit_ = true;
  const std::string d = bound_text(units->d);
  said_.remark((*length)->pointer, "unit",
               "diameters count as d, which is " + d + " " + units->unit + "; if they are in " +
                   units->unit + ", set sizes.distribution.size to " + d);
}

void GivenFiles::note_other_length(const std::string& pointer, double length,
                                   const std::string& what_is) {
  if (length != 1.0) note_other_d(pointer, length, what_is, "other lengths");
}

void GivenFiles::note_other_d(const std::string& pointer, double d, const std::string& what_is,
                              const std::string& others) {
  const GivenUnits& units = definition_.units;
  constexpr double rounding = 1e-6;
  if (!units || std::abs(d - units->d) <= rounding * units->d) return;
  said_.remark(pointer, "unit",
               "is not the d of units, " + bound_text(units->d) + " " + units->unit + ": if " +
                   what_is + " in " + units->unit + ", tables will give " + others + " in " +
                   units->unit + "; set both to one length");
}

bool GivenFiles::has_room(std::size_t count, const Block& block, const Assignment& source) {
  if (count > most_vertices_of_a_grain) {
    said_.problem(source, "holds " + in_thousands(count) + " vertices, more than the " +
                              in_thousands(most_vertices_of_a_grain) +
                              " that a grain may have; simplify the shape");
    return false;
  }
  vertices_ += count * static_cast<std::uint64_t>(block.replicates.most);
  if (vertices_ <= most_vertices) return true;
  said_.problem(source, "the jobs hold more than " + in_thousands(most_vertices) +
                            " vertices together; split the sweep");
  return false;
}

template <class Reading>
const Reading& GivenFiles::reading_of(const std::string& file, const Assignment& assignment,
                                      Reading (*read)(const std::string&),
                                      std::map<std::string, Reading>& files) {
  const std::string path = (std::filesystem::path(folder_) / file).string();
  const auto known = files.find(path);
  if (known != files.end()) return known->second;
  const Reading& reading = files.emplace(path, read(path)).first->second;
  if (!reading.errors.empty()) is_whole_ = false;
  for (const Diagnostic& error : reading.errors) {
    const bool has_no_line = error.place == path;  // then the name in the sweep is the place
    diagnostics_.push_back({assignment.pointer,
                            has_no_line ? path + " " + error.message : error.message, Anchor::value,
                            has_no_line ? "" : error.place});
  }
  return reading;
}

void GivenFiles::note_stray(const Assignment* part, const std::string& message) {
  if (part != nullptr && is_whole_) said_.problem(*part, message);
}

}  // namespace grainsweep
