#!/usr/bin/env bash
# clang-tidy finds nothing in engine, kernels and runner. usage: tidy.sh [ROOT [BUILD]]
# BUILD holds compile_commands.json; if not given, ROOT/build/tidy. It reads what the build compiles:
# where that is several sources at once, they share the time for their headers.
set -euo pipefail
cd -P "${1:-$(dirname "$0")/../..}"
readonly build=${2:-build/tidy}

(($# > 1)) || cmake --preset release -B "$build" --log-level=WARNING >/dev/null
if [[ ! -f $build/compile_commands.json ]]; then
  printf 'tidy: no %s/compile_commands.json\n' "$build" >&2
  exit 1
fi
mapfile -t sources < <(find kernels engine runner -name '*.cpp' 2>/dev/null | sort)
((${#sources[@]})) || { printf 'tidy: no sources found\n' >&2 && exit 1; }

# The file that the compiler is given for each source: itself, or one that includes it.
declare -A unit_of=()
mapfile -t compiled < <(sed -nE 's/^.*"file": "([^"]*)".*/\1/p' "$build/compile_commands.json" | sort -u)
for unit in "${compiled[@]}"; do
  unit_of[$unit]=$unit
  [[ -f $unit ]] || continue # the build writes it, and it includes none of ours
  while read -r source; do unit_of[$source]=$unit; done \
    < <(sed -nE 's/^#include "(\/.*\.cpp)"$/\1/p' "$unit")
done
units=()
for source in "${sources[@]}"; do
  unit=${unit_of[$PWD/$source]-}
  [[ $unit ]] || { printf 'tidy: %s is in no target of the build\n' "$source" >&2 && exit 1; }
  units+=("$unit")
done
printf '%s\n' "${units[@]}" | sort -u | tr '\n' '\0' |
  xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p "$build" \
    2> >(grep -vE "^[0-9]+ warnings? generated" >&2)
printf 'tidy: %d files\n' "${#sources[@]}"
