#!/usr/bin/env bash
# What the README tells people to write and type is understood. usage: readme.sh GRAINSWEEP
#
# Its sweep is valid, and every parameter and command in its tables is known to the program.
# shellcheck disable=SC2016  # backquotes here are those of the README
set -euo pipefail
grainsweep=$(realpath "${1:?usage: readme.sh GRAINSWEEP}")
readonly grainsweep
cd "$(dirname "$0")/../.."
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-readme.XXXXXX")
readonly work
trap 'rm -rf "$work"' EXIT

sed -n '/^```json$/,/^```$/{/^```/d;p}' README.md >"$work/readme.json"
[[ -s $work/readme.json ]] || { printf 'README.md: no sweep in it\n' >&2 && exit 1; }
"$grainsweep" validate "$work/readme.json"

# A parameter that exists is refused for its value (an empty object), an unknown one for its name.
mapfile -t parameters < <(sed -nE '/^\| parameter/,/^$/s/^\| (`[^|]*`) \|.*/\1/p' README.md |
  grep -oE '[a-z_]+(\.[a-z_]+)*')
((${#parameters[@]} > 10)) || { printf 'README.md: no table of parameters\n' >&2 && exit 1; }
for parameter in "${parameters[@]}"; do
  printf '{"name": "readme", "base": {"%s": {"no such key": 0}}}' "$parameter" >"$work/one.json"
  said=$("$grainsweep" validate "$work/one.json" 2>&1 || true)
  if [[ $said != *"/base/$parameter"* || $said == *"unknown key \"$parameter\""* ]]; then
    printf 'README.md: the program does not know %s:\n%s\n' "$parameter" "$said" >&2
    exit 1
  fi
done

mapfile -t commands < <(sed -nE '/^\| command/,/^$/s/^\| `([a-z]+)[ `].*/\1/p' README.md)
((${#commands[@]} > 3)) || { printf 'README.md: no table of commands\n' >&2 && exit 1; }
for command in "${commands[@]}"; do
  [[ $("$grainsweep" "$command" --help) == *"Usage: grainsweep $command "* ]] ||
    { printf 'README.md: the program does not know the command %s\n' "$command" >&2 && exit 1; }
done
printf 'README.md: its sweep, %d parameters and %d commands are known\n' \
  "${#parameters[@]}" "${#commands[@]}"
