#include "runner/tables/groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "runner/analysis/moderated.hpp"
#include "runner/analysis/student.hpp"
#include "runner/store/fields.hpp"
#include "runner/store/states.hpp"
#include "runner/sweep/parameters.hpp"
#include "runner/tables/component_names.hpp"

namespace grainsweep {
namespace {

using Members = std::vector<const Row*>;

/// The fields that have a mean in groups.csv.
const std::vector<Field>& mean_fields() {
  static const auto some = [] {
    std::vector<Field> chosen;
    for (const Field& field : fields()) {
      if (field.use.groups) chosen.push_back(field);
    }
    // The number of grains, known before they are measured, last.
    std::stable_partition(chosen.begin(), chosen.end(),
                          [](const Field& field) { return field.use.measured; });
    return chosen;
  }();
  return some;
}

/// Over the settled packings of a group.
Spread spread_over(const Members& members, const Field& field) {
  std::vector<double> values;
  for (const Row* row : members) {
    if (is_settled(*row)) values.push_back(number_of(field, *row->outcome));
  }
  return spread_of(values);
}

Group group_of(const Members& members) {
  Group group;
  group.job = members.front()->job;
  group.bias_bound = bias_bound(group.job);
  for (const Field& field : mean_fields()) group.means.push_back(spread_over(members, field));
  std::vector<double> heights;
  for (const Row* row : members) {
    count(*row, group.counts);
    if (!is_settled(*row)) continue;
    group.settled.emplace_back(*row->outcome);
    heights.push_back(slab_height(row->outcome->result));
  }
  group.slab_volume = group.job.box.floor_area() * spread_of(heights).mean;
  return group;
}

/// Finds the parameters that are not the same in all groups.
void note_varied(std::vector<Group>& groups) {
  std::vector<std::map<std::string, std::string>> all;
  std::map<std::string, std::map<std::string, std::size_t>> count;  // by path and value
  for (const Group& group : groups) {
    for (const auto& [path, value] : all.emplace_back(flat_parameters(group.job))) {
      ++count[path][value];
    }
  }
  for (const auto& [path, values] : count) {
    if (values.begin()->second == groups.size()) continue;
    for (std::size_t k = 0; k < groups.size(); ++k) groups[k].varied[path] = all[k][path];
  }
}

bool is_of_shape(const std::string& path) { return path == "shape" || path.starts_with("shape."); }

/// Its shape, of a mixture those of its components: what parts of shapes belong to.
std::string shapes_of(const Group& group) {
  const std::vector<std::string> components = component_names(group.job);
  if (components.empty()) return group.job.shape;
  std::string shapes;
  for (const std::string& name : components) shapes += (shapes.empty() ? "" : " and ") + name;
  return shapes;
}

/// Finds, among what is varied, what tells groups apart.
void note_told(std::vector<Group>& groups) {
  std::map<std::string, std::map<std::string, std::set<std::string>>> values;  // by shapes and path
  std::vector<std::string> shapes;
  shapes.reserve(groups.size());
  for (const Group& group : groups) {
    auto& of_shapes = values[shapes.emplace_back(shapes_of(group))];
    for (const auto& [path, value] : group.varied) of_shapes[path].insert(value);
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    Group& group = groups[k];
    const auto& of_shapes = values[shapes[k]];
    for (const auto& [path, value] : group.varied) {
      const bool is_part = is_of_shape(path) && component_of_share(path) == 0;
      if (!is_part || of_shapes.at(path).size() > 1) group.told[path] = value;
    }
    if (values.size() > 1) group.told["shape"] = shapes[k];
  }
}

/// A value of a parameter with short numbers.
std::string readable(const std::string& value) {
  std::string rounded = with_readable_numbers(unquoted(value));
  return rounded == unquoted(value) ? value : rounded;
}

/// Shortens the numbers of what tells groups apart, where their values stay apart.
void round_told(std::vector<Group>& groups) {
  std::map<std::string, std::pair<std::set<std::string>, std::set<std::string>>> values;
  for (const Group& group : groups) {
    for (const auto& [path, value] : group.told) {
      values[path].first.insert(value);
      values[path].second.insert(readable(value));
    }
  }
  for (Group& group : groups) {
    for (auto& [path, value] : group.told) {
      const auto& [as_they_are, rounded] = values[path];
      if (rounded.size() == as_they_are.size()) value = readable(value);
    }
  }
}

/// What tells its family from others of the same label, without the values that have no effect.
std::map<std::string, std::string> told_of_family(const Group& group,
                                                  const std::set<std::string>& idle) {
  std::map<std::string, std::string> told = group.told;
  for (const char* const path : {"box.width", "box.y", "tube.diameter"}) told.erase(path);
  for (const std::string& path : idle) told.erase(path);
  told["label"] = group.job.label;
  return told;
}

/// Finds, among what is varied, what groups do not depend on.
void note_idle(std::vector<Group>& groups) {
  std::map<std::map<std::string, std::string>, std::set<std::string>> families;
  std::vector<std::set<std::string>> idle;
  idle.reserve(groups.size());
  for (const Group& group : groups) {
    std::set<std::string>& paths = idle.emplace_back(idle_parameters(group.job));
    std::erase_if(paths, [&](const std::string& path) { return !group.varied.contains(path); });
    families[told_of_family(group, paths)].insert(group.family);
  }
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const bool are_alike = families[told_of_family(groups[k], idle[k])].size() > 1;
    if (!are_alike) groups[k].idle = std::move(idle[k]);
  }
}

void note_presets(std::vector<Group>& groups) {
  std::set<std::string> names;
  for (const Group& group : groups) {
    if (has_preset(group.job)) names.insert(group.job.accuracy);
  }
  const bool all_have_one = std::all_of(groups.begin(), groups.end(),
                                        [](const Group& group) { return has_preset(group.job); });
  for (Group& group : groups) {
    group.is_told_by_preset = has_preset(group.job) && (all_have_one || names.size() > 1);
  }
}

/// Whether other groups tell of its variance. That of phi and Z goes as one over the volume of the
/// slab; that of forces grows with the height of a bed, of order with the nearness of walls.
bool is_moderated(const Field& field) {
  return field.name == "solid_fraction" || field.name.starts_with("coordination");
}

constexpr double rounding_of_sums = 1e-12;  // of sums over the grains of a bed, relative

/// Whether replicates that scatter by no more than rounding are copies.
bool scatters(const Spread& spread, double by) {
  return by > rounding_of_sums * std::abs(spread.mean);
}

bool are_in_one_state(const Group& group) {
  return are_in_one_state(mean_of(group, "solid_fraction"), mean_of(group, "coordination"),
                          mean_of(group, "grains").mean);
}

double mean_slab_height(const Group& group) {
  return group.slab_volume / group.job.box.floor_area();
}

/// Gives a mean that is the same in all replicates the error of its rounding.
void make_exact(Spread& spread) {
  constexpr double above_rounding = 10.0;
  spread.error = above_rounding * rounding_of_sums * std::abs(spread.mean);
}

void moderate_errors(std::vector<Group>& groups) {
  std::map<std::string, std::vector<Group*>> families;
  for (Group& group : groups) families[group.family].push_back(&group);
  for (const auto& [name, family] : families) {
    for (std::size_t k = 0; k < mean_fields().size(); ++k) {
      if (!is_moderated(mean_fields()[k])) continue;
      std::vector<SlabMean> means;
      for (Group* group : family) {
        Spread& spread = group->means[k];
        if (are_in_one_state(*group) && !scatters(spread, spread.sd))
          make_exact(spread);
        else
          means.push_back({&spread, group->slab_volume});
      }
      moderate_errors(means);
      if (mean_fields()[k].name != "solid_fraction") continue;
      for (Group* group : family) {
        if (!are_in_one_state(*group)) continue;
        Spread& phi = group->means[k];
        phi.error = std::hypot(phi.error, error_of_layers(phi.mean, mean_slab_height(*group)));
      }
    }
  }
}

const JobFacts& job_of_group(const Group& group) { return group.job; }

Columns<Group> group_count_columns() {
  using In = const Group&;
  return {
      {"n", "",
       "settled packings, the only ones that enter means; a mean of what some of these lack, as "
       "segregation where a slab has no small grains, comes from the others",
       [](In group) { return cell(group.counts.settled); }},
      {"not_settled", "", "packings that did not settle",
       [](In group) { return cell(group.counts.not_settled); }},
      {"failed", "", "packings that failed", [](In group) { return cell(group.counts.failed); }},
      {"pending", "", "packings not made yet", [](In group) { return cell(group.counts.pending); }},
  };
}

Columns<Group> bias_columns() {
  const char* const meaning =
      "how far the mean lies at most from that of beds settled ever better; empty if not measured";
  const auto column = [&](const char* name, double ProtocolBias::*bound) {
    return Column<Group>{name, "", meaning, [=](const Group& group) {
                           return group.bias_bound ? cell((*group.bias_bound).*bound) : "";
                         }};
  };
  return {column("solid_fraction_bias_bound", &ProtocolBias::solid_fraction),
          column("coordination_bias_bound", &ProtocolBias::coordination)};
}

/// JSON on one line with numbers as jobs have them: 1e-04, which the library writes as 0.0001.
std::string as_in_jobs(const nlohmann::json& value) {
  if (value.is_number_float()) return cell(value.get<double>());
  if (!value.is_structured()) return value.dump();
  const char* const brackets = value.is_object() ? "{}" : "[]";
  std::string text(1, brackets[0]);
  for (const auto& [key, part] : value.items()) {
    if (text.size() > 1) text += ',';
    if (value.is_object()) text += nlohmann::json(key).dump() + ":";
    text += as_in_jobs(part);
  }
  return text + brackets[1];
}

/// Walls not counted; nothing where its packings did not measure it.
Spread mean_at(double tolerance, const Group& group) {
  std::vector<double> values;
  for (const Outcome& outcome : group.settled) {
    const Coordination* at = coordination_at(tolerance, outcome.result);
    if (at != nullptr) values.push_back(at->between_grains);
  }
  return spread_of(std::move(values));
}

}  // namespace

bool is_square_duct(const Box& box) {
  return !box.is_tube && box.x == Boundary::walls && box.y == Boundary::walls &&
         box.length == box.width;
}

std::string parameters_of_family(const JobFacts& job, bool is_over_squares) {
  nlohmann::json parameters = nlohmann::json::parse(job.parameters.text());
  if (parameters.contains("box")) {
    parameters["box"].erase("width");
    parameters["box"].erase("y");
    if (is_over_squares) parameters["box"].erase("length");
  }
  if (parameters.contains("tube")) parameters["tube"].erase("diameter");
  return as_in_jobs(parameters);
}

std::vector<std::string> parameters_of_families(const std::vector<JobFacts>& jobs) {
  std::vector<std::string> families;
  std::map<std::string, std::set<double>> widths, sides;  // by family, and by that of squares
  families.reserve(jobs.size());
  for (const JobFacts& job : jobs) {
    families.push_back(parameters_of_family(job));
    if (job.box.y == Boundary::walls) widths[families.back()].insert(job.box.width);
    if (is_square_duct(job.box)) sides[parameters_of_family(job, true)].insert(job.box.width);
  }
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    if (!is_square_duct(jobs[k].box) || widths[families[k]].size() > 1) continue;
    std::string of_squares = parameters_of_family(jobs[k], true);
    if (sides[of_squares].size() > 1) families[k] = std::move(of_squares);
  }
  return families;
}

GroupWithCurves::GroupWithCurves(Group group, const std::string& folder)
    : group_(std::move(group)) {
  outcomes_.assign(group_.settled.begin(), group_.settled.end());
  group_.settled.assign(outcomes_.begin(), outcomes_.end());
  for (Outcome& outcome : outcomes_) {
    if (outcome.stored_bytes > 0)
      static_cast<Curves&>(outcome.result) = read_bed(folder, outcome).curves;
  }
}

double error_of_mean(double variance, int n, double degrees_of_freedom) {
  return student_quantile(degrees_of_freedom) / normal_quantile * std::sqrt(variance / n);
}

void moderate_errors(const std::vector<SlabMean>& means) {
  std::vector<KnownVariance> own;
  for (const auto& [spread, volume] : means) {
    const bool tells = spread->n > 1 && scatters(*spread, spread->sd);
    own.push_back({tells ? spread->sd * spread->sd * volume : 0.0,
                   static_cast<double>(std::max(0, spread->n - 1))});
  }
  const std::vector<KnownVariance> all = moderated(own);
  for (std::size_t k = 0; k < means.size(); ++k) {
    const auto& [spread, volume] = means[k];
    spread->degrees_of_freedom = spread->n > 0 ? all[k].degrees_of_freedom : 0.0;
    if (spread->degrees_of_freedom == 0.0) continue;
    spread->error = error_of_mean(all[k].variance / volume, spread->n, spread->degrees_of_freedom);
  }
}

bool are_in_one_state(const Spread& phi, const Spread& z, double grains) {
  constexpr double same = 1e-5, next_to_none = 1e-3;
  if (!scatters(phi, phi.sd)) return false;
  const bool have_one_z = !scatters(z, z.sd);
  return phi.sd < same * phi.mean || (have_one_z && phi.sd * std::sqrt(grains) < next_to_none);
}

double error_of_layers(double solid_fraction, double slab_height) {
  return solid_fraction / (9.0 * slab_height);
}

double slab_height(const PackingResult& result) { return result.slab_top - result.slab_bottom; }

Spread spread_of(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  Spread spread{no_number, no_number, static_cast<int>(values.size()), no_number, 0.0};
  if (values.empty()) return spread;
  double sum = 0.0, squares = 0.0;
  for (const double value : values) sum += value;
  spread.mean = sum / spread.n;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (spread.n < 2) return spread;
  spread.degrees_of_freedom = static_cast<double>(spread.n) - 1.0;
  const double variance = squares / spread.degrees_of_freedom;
  spread.sd = std::sqrt(variance);
  spread.error = error_of_mean(variance, spread.n, spread.degrees_of_freedom);
  return spread;
}

std::string why_no_error(const Spread& spread) {
  if (spread.n == 0) return "no packing has settled";
  if (spread.degrees_of_freedom == 0.0)
    return "needs 2 or more settled replicates to know the error";
  if (scatters(spread, spread.error)) return "";
  return "the replicates do not scatter, as copies or packings of one possible state: they tell no "
         "error";
}

std::vector<std::size_t> group_numbers(const std::vector<Row>& rows) {
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> known;
  std::vector<std::size_t> numbers;
  numbers.reserve(rows.size());
  for (const Row& row : rows) {
    const std::size_t next = known.size() + 1;
    numbers.push_back(
        known.try_emplace({row.job.label, row.job.parameters.text()}, next).first->second);
  }
  return numbers;
}

std::vector<Group> groups_of(const std::vector<Row>& rows) {
  const std::vector<std::size_t> numbers = group_numbers(rows);
  std::vector<Members> members;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (numbers[k] > members.size()) members.emplace_back();
    members[numbers[k] - 1].push_back(&rows[k]);
  }
  std::vector<Group> groups;
  groups.reserve(members.size());
  for (const Members& some : members) {
    groups.push_back(group_of(some));
    groups.back().number = groups.size();
  }
  std::vector<JobFacts> jobs;
  jobs.reserve(groups.size());
  for (const Group& group : groups) jobs.push_back(group.job);
  const std::vector<std::string> families = parameters_of_families(jobs);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    groups[k].family = families[k];
    groups[k].is_of_squares = families[k] != parameters_of_family(jobs[k]);
  }
  note_varied(groups);
  note_told(groups);
  round_told(groups);
  note_idle(groups);
  note_presets(groups);
  moderate_errors(groups);
  return groups;
}

const Spread& mean_of(const Group& group, std::string_view field) {
  for (std::size_t k = 0; k < group.means.size(); ++k) {
    if (mean_fields()[k].name == field) return group.means[k];
  }
  throw std::out_of_range("no mean of " + std::string(field));
}

Varied varied_of(const Group& any) {
  Varied paths;
  for (const auto& [path, value] : any.varied) paths.push_back(path);
  return paths;
}

Varied varied_of(const std::vector<Group>& groups) {
  return groups.empty() ? Varied() : varied_of(groups.front());
}

Columns<Group> group_key_columns() {
  using In = const Group&;
  return {{"group", "", "number of its row in groups.csv, from 1",
           [](In group) { return cell(group.number); }},
          {"family", "", "name of the packings that differ in nothing but width and boundary_y",
           [](In group) { return cell(group.family_name); }}};
}

Columns<Group> varied_columns(const Varied& varied) {
  Columns<Group> columns;
  for (const std::string& path : varied) {
    const auto known = find_parameter(path);
    columns.push_back({path, known ? parameters()[*known].unit : "",
                       known ? parameters()[*known].meaning : "of the sweep",
                       [path](const Group& group) { return group.varied.at(path); }});
  }
  return columns;
}

Columns<Group> group_line_columns(const Varied& varied) {
  Columns<Group> columns = group_key_columns();
  std::vector<std::string> names = {"job", "label", "width", "boundary_y", "small_share"};
  // Where it varies, the name of every shape: as a parameter only spheres have one.
  if (std::find(varied.begin(), varied.end(), "shape") != varied.end()) names.emplace_back("shape");
  append(columns, job_columns(names), job_of_group);
  append(columns, varied_columns(varied));
  remove_repeated(columns);
  return columns;
}

const Coordination* coordination_at(double tolerance, const PackingResult& result) {
  const auto at =
      std::find_if(result.coordination.begin(), result.coordination.end(),
                   [=](const Coordination& one) { return one.gap_tolerance == tolerance; });
  return at == result.coordination.end() ? nullptr : &*at;
}

std::vector<double> further_tolerances(const std::vector<Group>& groups) {
  std::vector<double> tolerances;
  for (const Group& group : groups) {
    const auto& own = group.job.measure.gap_tolerances;
    if (!own.empty()) tolerances.insert(tolerances.end(), own.begin() + 1, own.end());
  }
  std::sort(tolerances.begin(), tolerances.end());
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end()), tolerances.end());
  return tolerances;
}

Columns<Group> groups_columns(const std::vector<double>& further_tolerances, const Varied& varied,
                              const GivenUnits& units) {
  Columns<Group> columns = group_key_columns();
  append(columns,
         job_columns({"job", "label", "shape", "length", "width", "boundary_x", "boundary_y",
                      "small_share", "accuracy"}),
         job_of_group);
  append(columns, group_count_columns());
  for (std::size_t k = 0; k < mean_fields().size(); ++k) {
    const Field& field = mean_fields()[k];
    append_spread(columns, std::string(field.name), std::string(field.unit),
                  std::string(field.meaning), [k](const Group& group) { return group.means[k]; });
    if (!is_moderated(field)) continue;
    columns.back().meaning =
        "standard error of the mean, from the variance of replicates, moderated by that of the "
        "others of the family";
  }
  for (const double tolerance : further_tolerances) {
    append_spread(columns, "coordination_at_" + cell(tolerance), "",
                  "coordination at a gap tolerance of so many d",
                  [=](const Group& group) { return mean_at(tolerance, group); });
  }
  append(columns, bias_columns());
  append(columns, varied_columns(varied));
  append(columns, job_columns({"parameters"}), job_of_group);
  remove_repeated(columns);
  append_in_units(columns, units);
  return columns;
}

std::string groups_csv(const std::vector<Group>& groups, const GivenUnits& units) {
  const Columns<Group> columns =
      groups_columns(further_tolerances(groups), varied_of(groups), units);
  std::string text = header_line(columns);
  for (const Group& group : groups) text += row_line(columns, group);
  return text;
}

}  // namespace grainsweep
