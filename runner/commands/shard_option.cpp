#include "runner/commands/shard_option.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

/// The variables that an engine gives its tasks. Tasks count from `first`, which is a variable or a
/// number, in steps of the variable `step`; the engine gives their count, the number of the last,
/// or neither.
struct TaskVariables {
  const char* engine = nullptr;
  const char* number = nullptr;
  const char* first = nullptr;
  const char* step = nullptr;
  const char* count = nullptr;
  const char* last = nullptr;
};

constexpr std::array arrays = {
    TaskVariables{"Slurm array", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN",
                  "SLURM_ARRAY_TASK_STEP", "SLURM_ARRAY_TASK_COUNT"},
    TaskVariables{"Grid Engine", "SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_STEPSIZE", nullptr,
                  "SGE_TASK_LAST"},
    TaskVariables{"PBS array", "PBS_ARRAY_INDEX", "1"},
    TaskVariables{"Torque array", "PBS_ARRAYID", "1"},
    TaskVariables{"HyperQueue", "HQ_TASK_ID", "1"},
};

/// Slurm comes last: programs that mpirun starts inherit its variables, too.
constexpr std::array ranks = {
    TaskVariables{"Open MPI", "OMPI_COMM_WORLD_RANK", "0", nullptr, "OMPI_COMM_WORLD_SIZE"},
    TaskVariables{"PMI", "PMI_RANK", "0", nullptr, "PMI_SIZE"},
    TaskVariables{"Flux", "FLUX_TASK_RANK", "0", nullptr, "FLUX_JOB_SIZE"},
    TaskVariables{"Slurm tasks", "SLURM_PROCID", "0", nullptr, "SLURM_STEP_NUM_TASKS"},
};

std::optional<int> integer_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_all = error == std::errc() && end == text.data() + text.size();
  return is_all ? std::optional(number) : std::nullopt;
}

/// The number in a variable, or in its name where that is a number; nothing if there is none.
std::optional<int> number_of(const char* variable, const Environment& environment) {
  if (variable == nullptr) return std::nullopt;
  const char* const value = environment(variable);
  return integer_in(value != nullptr ? value : variable);
}

/// What one engine says: the number of a task from 0, and of how many if it says so. In 64 bits
/// sums and products of two variables of 32 bits have room, whatever these hold.
struct Task {
  std::int64_t index = 0;
  std::optional<std::int64_t> count;
};

std::optional<Task> task_of(const TaskVariables& names, const Environment& environment) {
  const auto number = number_of(names.number, environment);
  const auto first = number_of(names.first, environment);
  if (!number || !first) return std::nullopt;
  const std::int64_t from = *first,
                     step = std::max(1, number_of(names.step, environment).value_or(1));
  Task task{(*number - from) / step, number_of(names.count, environment)};
  if (const auto last = number_of(names.last, environment)) task.count = (*last - from) / step + 1;
  const bool is_rank = names.first == std::string_view("0");
  return is_rank && !task.count ? std::nullopt : std::optional(task);
}

template <class Rows>
std::optional<Task> first_task(const Rows& rows, const Environment& environment) {
  for (const TaskVariables& names : rows) {
    if (auto task = task_of(names, environment)) return task;
  }
  return std::nullopt;
}

template <class Rows>
std::string listed(const Rows& rows) {
  std::string text;
  for (const TaskVariables& names : rows) {
    text += std::string("\n  ") + names.engine + ": " + names.number;
    const bool is_variable = names.first != nullptr && std::isalpha(names.first[0]) != 0;
    if (is_variable) text += std::string(", ") + names.first;
    if (names.count != nullptr) text += std::string(" and ") + names.count;
    if (names.last != nullptr) text += std::string(" and ") + names.last;
  }
  return text;
}

std::string too_many_text(std::int64_t count) {
  return std::to_string(count) + " are too many: a sweep has " + std::to_string(most_shards) +
         " shards at most";
}

/// `given`: how many shards the user says there are.
Shard shard_of_task(const Environment& environment, std::optional<int> given) {
  const auto element = first_task(arrays, environment), rank = first_task(ranks, environment);
  if (!element && !rank) {
    throw BadInput("--shard auto: no numbers in variables tell which task this is; looked for" +
                   listed(arrays) + listed(ranks) + "\ngive the shard itself, --shard 3/64");
  }
  if (element && !element->count && !given) {
    throw BadInput(
        "--shard auto: this engine tells the number of a task, not how many there are; "
        "add that, --shard auto/64");
  }
  const std::int64_t ranks_each = rank ? std::max<std::int64_t>(1, *rank->count) : 1;
  std::int64_t told = 1;
  if (element) told = element->count ? *element->count : *given / ranks_each;
  const std::int64_t count = told * ranks_each;
  const std::int64_t number =
      (element ? element->index : 0) * ranks_each + (rank ? rank->index : 0) + 1;
  if (number < 1 || number > count || (given && *given != count)) {
    throw BadInput(
        "--shard auto: this is task " + std::to_string(number) + " of " + std::to_string(count) +
        (given ? ", not one of " + std::to_string(*given) : std::string()) +
        "; number the tasks from 1 without gaps, or give the shard itself, --shard 3/64");
  }
  if (count > most_shards) throw BadInput("--shard auto: " + too_many_text(count));
  return {static_cast<int>(number), static_cast<int>(count)};
}

}  // namespace

Shard shard_from_option(const std::string& text, const Environment& environment) {
  if (text.empty()) return {};
  if (text == "auto") return shard_of_task(environment, std::nullopt);
  const std::string_view automatic = "auto/";
  if (text.starts_with(automatic)) {
    const auto count = integer_in(std::string_view(text).substr(automatic.size()));
    if (count && *count >= 1 && *count <= most_shards) return shard_of_task(environment, count);
  }
  const auto shard = shard_from_text(text);
  if (shard && shard->count > most_shards) {
    throw BadInput("--shard " + text + ": " + too_many_text(shard->count));
  }
  if (!shard) {
    throw BadInput("--shard " + text +
                   ": give its number and how many there are, --shard 3/64, or --shard auto");
  }
  return *shard;
}

}  // namespace grainsweep
