#include "runner/commands/shared_options.hpp"

#include <cstdlib>

#include <CLI/App.hpp>

#include "runner/tables/csv.hpp"

namespace grainsweep {

CLI::Option* add_jobs(CLI::App& command, std::vector<std::string>& jobs,
                      const std::string& meaning) {
  return command.add_option("--job", jobs, meaning)
      ->type_name("ID")
      ->option_text("ID[,ID...]")
      ->delimiter(',')
      ->allow_extra_args(false);
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "packings at once (default: one per core)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
}

void add_tolerance(CLI::App& command, double& share, const std::string& meaning) {
  command.add_flag("--tolerate-unsettled{1}", meaning)
      ->check(number_within(0.0, 1.0).description(""))  // the text says what it may be
      ->option_text("[=SHARE]")
      ->each([&share](const std::string& word) { share = std::strtod(word.c_str(), nullptr); });
}

CLI::Validator number_within(double least, double most) {
  const std::string from = cell(least), to = cell(most);
  const auto mistake = [=](const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    const bool is_number = !word.empty() && *end == '\0';
    if (is_number && least <= value && value <= most) return std::string();
    return "must be a number in [" + from + ", " + to + "], is " + word;
  };
  return {mistake, "FLOAT in [" + from + " - " + to + "]"};
}

CLI::Validator not_empty() {
  const auto mistake = [](const std::string& word) {
    return word.empty() ? std::string("is empty; give it a value or leave it out") : std::string();
  };
  return {mistake, ""};
}

void add_file(CLI::App& command, std::string& file) {
  command.add_option("FILE", file, "sweep definition, JSON")->required()->type_name("");
}

void add_folder(CLI::App& command, std::string& folder) {
  command.add_option("DIR", folder, "output folder of a run")->required()->type_name("");
}

}  // namespace grainsweep
