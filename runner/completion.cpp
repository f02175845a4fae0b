// The command `completion`.
#include "runner/completion.hpp"

#include <iostream>

#include "runner/commands.hpp"
#include "runner/exit_codes.hpp"

namespace grainsweep {
namespace {

constexpr const char* first_lines =
    "# Completion of grainsweep for bash. Put into ~/.bashrc:\n"
    "#   source <(grainsweep completion bash)\n"
    "_grainsweep() {\n"
    "  local word=${COMP_WORDS[COMP_CWORD]} words=''\n"
    "  COMPREPLY=()\n"
    "  case ${COMP_WORDS[COMP_CWORD - 1]} in\n"
    "    --isa) words='sse2 avx2 avx512' ;;\n"
    "    --format) words='csv xyz vtp' ;;\n"
    "    completion) [[ $word == -* ]] || words='bash' ;;\n"
    "  esac\n"
    "  if [[ -z $words && $word == -* ]]; then\n"
    "    case ${COMP_WORDS[1]} in\n";

constexpr const char* last_lines =
    "  if [[ -n $words ]]; then mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\"); fi\n"
    "}\n"
    "complete -o default -F _grainsweep grainsweep\n";

std::string line_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

std::string bash_completion(const std::vector<CommandWords>& commands) {
  std::string text = first_lines;
  std::vector<std::string> names;
  for (const CommandWords& one : commands) {
    names.push_back(one.command);
    text += "      " + one.command + ") words='" + line_of(one.options) + "' ;;\n";
  }
  return text +
         "    esac\n"
         "  fi\n"
         "  if ((COMP_CWORD == 1)); then words='" +
         line_of(names) + "'; fi\n" + last_lines;
}

int completion(const CompletionOptions& options) {
  std::cout << bash_completion(options.commands);
  return exit_done;
}

}  // namespace grainsweep
