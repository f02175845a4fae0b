#include "runner/commands/command_line.hpp"

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "runner/commands/shared_options.hpp"
#include "runner/exit_codes.hpp"
#include "runner/machine.hpp"
#include "runner/sweep/suggest.hpp"
#include "runner/sweep/text_lines.hpp"
#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

using Words = std::vector<std::string>;

Words options_of(const CLI::App& command) {
  Words options;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  return options;
}

/// What is wrong with a word that is not among `known`; "" if it is.
std::string misspelling(const std::string& what, const std::string& word, const Words& known) {
  if (std::find(known.begin(), known.end(), word) != known.end()) return "";
  const std::string near = nearest(word, known);
  return "unknown " + what + " " + word +
         (near.empty() ? "; known: " + comma_list(known) : "; did you mean " + near + "?");
}

/// For whoever gives two output folders to `compare`.
constexpr const char* compared_with =
    "\ncompare sets one run beside published values, --with FILE; to compare two runs, set the "
    "rows of\ntheir groups.csv beside each other";

/// What is wrong with the command line, `words` after the program's name.
std::string mistake(const CLI::App& app, const Words& words, const CLI::Error& error) {
  Words commands = {"help", "version"}, options;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    commands.push_back(command->get_name());
    if (!words.empty() && command->get_name() == words[0]) options = options_of(*command);
  }
  std::string found;
  for (std::size_t i = 0; i < words.size() && found.empty(); ++i) {
    const std::string word = words[i].substr(0, words[i].find('='));
    if (i == 0 && !word.starts_with("-")) found = misspelling("command", word, commands);
    if (i > 0 && word.starts_with("--")) found = misspelling("option", word, options);
  }
  if (!found.empty()) return found;
  const bool has_more = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError);
  const bool has_two_folders = has_more && words[0] == "compare";
  const bool has_ids = has_more && std::find(words.begin(), words.end(), "--job") != words.end();
  return std::string(error.what()) + (has_two_folders ? compared_with : "") +
         (has_ids ? "; of several ids each has its --job, or commas stand between them" : "");
}

constexpr std::size_t help_width = 80, help_names = 24;  // characters of lines, and of names

/// Writes "--flag[=SHARE]" in the place of CLI11's "--flag{1} [=SHARE]", and no line too long.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* command) const override {
    const std::string text = CLI::Formatter::make_description(command);
    return text.empty() ? text : filled_lines(text, help_width) + "\n";
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return filled_lines(CLI::Formatter::make_option_desc(option), help_width - help_names);
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::stringstream text;
    CLI::detail::format_help(text, command->get_name(),
                             filled_lines(command->get_description(), help_width - help_names),
                             help_names);
    return text.str();
  }
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    const std::string name = CLI::Formatter::make_option_name(option, is_positional);
    return name.substr(0, name.find('{'));
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string text = CLI::Formatter::make_option_opts(option);
    return text.starts_with(" [") ? text.substr(1) : text;
  }
};

/// "help", "help COMMAND" and "version" as the options that mean the same.
Words with_options(const CLI::App& app, const Words& words) {
  if (words == Words{"version"}) return {"--version"};
  if (words == Words{"help"}) return {"--help"};
  if (words.size() != 2 || words[0] != "help") return words;
  const auto is_named = [&](const CLI::App* command) { return command->check_name(words[1]); };
  if (app.get_subcommands(is_named).empty()) return {words[1]};
  return {words[1], "--help"};
}

/// Makes the examples in its help begin with the name that the program was called by.
void call_examples(CLI::App& command) {
  command.footer(replaced(command.get_footer(), ": grainsweep ", ": " + called_as() + " "));
}

}  // namespace

void describe(CLI::App& app, AllOptions& all) {
  app.name("grainsweep");
  app.description("grainsweep " + program_version() +
                  ": packs beds of rigid frictionless grains as a JSON sweep file\n"
                  "says, and measures how walls change solid fraction and coordination number.");
  app.set_version_flag("--version",
                       "grainsweep " + program_version() + " (" + source_commit() + ")");
  app.require_subcommand(1);
  app.formatter(std::make_shared<HelpFormatter>());
  app.get_formatter()->column_width(help_names);
  app.footer(std::string("Example: grainsweep run configs/quick.json --out out/quick\n"
                         "Help on a command: grainsweep run --help\n\n") +
             exit_codes_text);
  std::apply([&](auto&... options) { (add_command(app, options), ...); }, all);
}

CommandLine read_command_line(int argc, const char* const* argv) {
  CLI::App app;
  AllOptions all;
  describe(app, all);
  call_examples(app);
  Words words(argv + std::min(1, argc), argv + argc);
  app.failure_message([&](const CLI::App* /*app*/, const CLI::Error& error) {
    return "grainsweep: " + lines_without_controls(mistake(app, words, error)) +
           "\nRun with --help for more information.\n";
  });
  CommandLine line;
  std::vector<CLI::App*> commands = app.get_subcommands(nullptr);
  std::size_t number = 0;
  const auto listen_to = [&](auto& options) {
    CLI::App& command = *commands[number++];
    command.callback([&] { line.command = options; });
    call_examples(command);
  };
  std::apply([&](auto&... options) { (listen_to(options), ...); }, all);
  words = with_options(app, words);
  try {
    app.parse(Words(words.rbegin(), words.rend()));  // CLI11 takes them from the end
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? exit_done : exit_bad_input};
  }
  return line;
}

}  // namespace grainsweep
