#!/usr/bin/env bash
# Runs all extreme scenes and writes their table, sorted, into bench/extremes.md below the text that
# stands there. About two minutes. usage: bench/extremes.sh
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root page=$root/bench/extremes.md

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target bench_extremes >/dev/null
table=$(mktemp "${TMPDIR:-/tmp}/grainsweep-extremes.XXXXXX")
readonly table
trap 'rm -f "$table" "$table.page"' EXIT
status=0
"$root/build/release/bench/bench_extremes" >"$table" || status=$?
((status <= 1)) || exit "$status"
{
  sed '/^|/,$d' "$page"
  head -n 2 "$table"
  tail -n +3 "$table" | LC_ALL=C sort
} >"$table.page"
cat "$table.page" >"$page"
exit "$status"
