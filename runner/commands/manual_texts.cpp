#include "runner/commands/manual_texts.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "runner/text.hpp"
#include "runner/versions.hpp"

namespace grainsweep {
namespace {

std::vector<const CLI::App*> commands_in(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* /*any*/) { return true; });
}

/// Those that begin with dashes, and those that do not.
std::vector<const CLI::Option*> options_in(const CLI::App& command, bool is_positional) {
  return command.get_options(
      [=](const CLI::Option* option) { return option->get_positional() == is_positional; });
}

/// "--out", or "-h" where there is no long one.
std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

bool takes_a_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

/// What stands for its value, "N"; CLI11 writes the allowed values after a colon.
std::string operand_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find(':'));
}

/// The allowed values: the names of a set without its braces; "" if it is no set.
std::string names_in_set(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find(":{"), end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos) return "";
  return type.substr(begin + 2, end - begin - 2);
}

std::string on_one_line(const std::string& text) { return replaced(text, "\n", " "); }

/// For roff, to which a backslash, a hyphen, and a dot or quote that begins a line are special.
std::string roff(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char c : text) {
    if (begins_line && (c == '.' || c == '\'')) escaped += "\\&";
    if (c == '-') escaped += '\\';
    escaped += c == '\\' ? std::string("\\e") : std::string(1, c);
    begins_line = c == '\n';
  }
  return escaped;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string page_head(const std::string& name, const std::string& purpose) {
  return ".TH " + roff(upper(name)) + " 1 \"\" \"grainsweep " + program_version() +
         "\" \"User Commands\"\n.SH NAME\n" + roff(name) + " \\- " + roff(on_one_line(purpose)) +
         "\n.SH SYNOPSIS\n";
}

std::string option_entry(const CLI::Option& option) {
  std::string names;
  for (const std::string& name : names_of(option))
    names += (names.empty() ? "" : ", ") + bold(name);
  if (takes_a_value(option)) names += " " + italic(operand_of(option));
  return ".TP\n" + names + "\n" + roff(option.get_description()) + "\n";
}

std::string operand_entry(const CLI::Option& option) {
  return ".TP\n" + italic(option.get_name(true)) + "\n" + roff(option.get_description()) + "\n";
}

/// The footer of a help, whose lines stand as they are.
std::string notes(const CLI::App& app) {
  return app.get_footer().empty() ? "" : ".SH NOTES\n.nf\n" + roff(app.get_footer()) + "\n.fi\n";
}

std::string command_page(const CLI::App& command) {
  const std::string name = "grainsweep " + command.get_name();
  std::string text = page_head("grainsweep-" + command.get_name(), command.get_description()) +
                     bold(name) + " [" + italic("OPTIONS") + "]";
  std::string entries;
  for (const CLI::Option* operand : options_in(command, true)) {
    text += " " + italic(operand->get_name(true));
    entries += operand_entry(*operand);
  }
  for (const CLI::Option* option : options_in(command, false)) entries += option_entry(*option);
  return text + "\n.SH OPTIONS\n" + entries + notes(command) + ".SH SEE ALSO\n.BR grainsweep (1)\n";
}

std::string program_page(const CLI::App& app) {
  std::string text = page_head("grainsweep", "pack beds of rigid grains and measure them") +
                     bold("grainsweep") + " " + italic("COMMAND") + " [" + italic("OPTIONS") +
                     "]\n.SH DESCRIPTION\n" + roff(app.get_description()) + "\n.SH COMMANDS\n";
  std::string see;
  for (const CLI::App* command : commands_in(app)) {
    text += ".TP\n" + bold(command->get_name()) + "\n" + roff(command->get_description()) + "\n";
    see += (see.empty() ? ".BR " : " ,\n.BR ") + roff("grainsweep-" + command->get_name()) + " (1)";
  }
  text += ".SH OPTIONS\n";
  for (const CLI::Option* option : options_in(app, false)) text += option_entry(*option);
  return text + notes(app) + ".SH SEE ALSO\n" + see + "\n";
}

std::string option_words(const CLI::App& command) {
  std::string words;
  for (const CLI::Option* option : options_in(command, false)) {
    for (const std::string& name : names_of(*option)) words += (words.empty() ? "" : " ") + name;
  }
  return words;
}

std::string command_words(const CLI::App& app) {
  std::string words;
  for (const CLI::App* command : commands_in(app)) words += command->get_name() + " ";
  return words;
}

/// In single quotes for zsh and fish; brackets and colons are special to zsh.
std::string in_quotes(const std::string& text) {
  return "'" + replaced(on_one_line(text), "'", "’") + "'";
}

/// The value of an option and how it is completed: from its set, or as the name of a file.
std::string zsh_value(const CLI::Option& option) {
  const std::string names = names_in_set(option);
  const bool is_number = option.get_type_name().find(" in [") != std::string::npos;
  const std::string action = !names.empty() ? "(" + replaced(names, ",", " ") + ")"
                             : is_number    ? " "
                                            : "_files";
  return ":" + operand_of(option) + ":" + action;
}

std::string zsh_words(const CLI::Option& option) {
  std::string text = replaced(replaced(option.get_description(), "[", "("), "]", ")");
  text = replaced(text, ":", "\\:");
  std::string words;
  for (const std::string& name : names_of(option)) {
    const std::string value = takes_a_value(option) ? zsh_value(option) : "";
    words += " \\\n        " + in_quotes(name + "[" + text + "]" + value);
  }
  return words;
}

}  // namespace

std::map<std::string, std::string> manual_pages(const CLI::App& app) {
  std::map<std::string, std::string> pages = {{"grainsweep.1", program_page(app)}};
  for (const CLI::App* command : commands_in(app)) {
    pages["grainsweep-" + command->get_name() + ".1"] = command_page(*command);
  }
  return pages;
}

std::string bash_completion(const CLI::App& app) {
  std::string cases;
  for (const CLI::App* command : commands_in(app)) {
    cases += "    " + command->get_name() + ") words='" + option_words(*command) + "' ;;\n";
  }
  return "# bash completion of grainsweep\n"
         "_grainsweep() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} words=''\n"
         "  case $COMP_CWORD:${COMP_WORDS[1]} in\n"
         "    1:*) words='" +
         command_words(app) + "help version " + option_words(app) + "' ;;\n    2:help) words='" +
         command_words(app) +
         "' ;;\n  esac\n  if [[ $COMP_CWORD -gt 1 && $word == -* ]]; then\n"
         "    case ${COMP_WORDS[1]} in\n" +
         cases +
         "    esac\n  fi\n"
         "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "}\n"
         "complete -o default -F _grainsweep grainsweep\n";
}

std::string zsh_completion(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : commands_in(app)) {
    commands += "    " + in_quotes(command->get_name() + ":" + command->get_description()) + "\n";
    cases += "    " + command->get_name() + ")\n      _arguments";
    for (const CLI::Option* option : options_in(*command, false)) cases += zsh_words(*option);
    cases += " \\\n        '*:file:_files'\n      ;;\n";
  }
  return "#compdef grainsweep\n"
         "_grainsweep() {\n"
         "  local -a commands=(\n" +
         commands +
         "  )\n"
         "  if ((CURRENT == 2)); then\n"
         "    _describe command commands\n"
         "    return\n"
         "  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $command in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_grainsweep \"$@\"\n";
}

std::string fish_completion(const CLI::App& app) {
  std::string text = "# fish completion of grainsweep\n";
  for (const CLI::App* command : commands_in(app)) {
    const std::string& name = command->get_name();
    text += "complete -c grainsweep -n __fish_use_subcommand -f -a " + name + " -d " +
            in_quotes(command->get_description()) + "\n";
    for (const CLI::Option* option : options_in(*command, false)) {
      if (option->get_lnames().empty()) continue;
      text += "complete -c grainsweep -n '__fish_seen_subcommand_from " + name + "' -l " +
              option->get_lnames().front() + (takes_a_value(*option) ? " -r" : "") + " -d " +
              in_quotes(option->get_description()) + "\n";
    }
  }
  return text;
}

}  // namespace grainsweep
