#!/usr/bin/env bash
# clang-tidy finds nothing in engine, kernels and runner. usage: tidy.sh [ROOT [BUILD]]
# BUILD holds compile_commands.json; ROOT/build/release if not given.
set -euo pipefail
cd "${1:-$(dirname "$0")/../..}"
readonly build=${2:-build/release}

if [[ ! -f $build/compile_commands.json ]]; then
  printf 'tidy: no %s/compile_commands.json; build first\n' "$build" >&2
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
