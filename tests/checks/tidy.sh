#!/usr/bin/env bash
# clang-tidy finds nothing in engine, kernels and runner. usage: tidy.sh [ROOT [BUILD]]
# BUILD holds compile_commands.json; if not given, ROOT/build/tidy, configured to compile each source
# alone: that none leans on the includes of another is checked by the way.
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"
readonly build=${2:-build/tidy}

(($# > 1)) || cmake --preset release -B "$build" -DCMAKE_UNITY_BUILD=OFF --log-level=WARNING >/dev/null
if [[ ! -f $build/compile_commands.json ]]; then
  printf 'tidy: no %s/compile_commands.json\n' "$build" >&2
  exit 1
fi
mapfile -d '' -t sources < <(find kernels engine runner -name '*.cpp' -print0 2>/dev/null | sort -z)
((${#sources[@]})) || { printf 'tidy: no sources found\n' >&2 && exit 1; }

# A file that is not part of the build would be checked with guessed flags: say so instead.
for source in "${sources[@]}"; do
  grep -qF "/$source\"" "$build/compile_commands.json" ||
    { printf 'tidy: %s is in no target of the build\n' "$source" >&2 && exit 1; }
done
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy --quiet -p "$build" \
  2> >(grep -vE "^[0-9]+ warnings? generated" >&2)
printf 'tidy: %d files\n' "${#sources[@]}"
