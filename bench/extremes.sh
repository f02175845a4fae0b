#!/usr/bin/env bash
# Runs all extreme scenes and writes their table into README.md, between the lines that mark it.
# About two minutes. usage: bench/extremes.sh
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target bench_extremes >/dev/null
table=$(mktemp "${TMPDIR:-/tmp}/grainsweep-extremes.XXXXXX")
readonly table
trap 'rm -f "$table" "$table.readme"' EXIT
status=0
"$root/build/release/bench/bench_extremes" >"$table" || status=$?
((status <= 1)) || exit "$status"
awk -v table="$table" '
  /^<!-- extremes: end -->$/ { inside = 0 }
  !inside { print }
  /^<!-- extremes: begin -->$/ { inside = 1; while ((getline line <table) > 0) print line }
' "$root/README.md" >"$table.readme"
cat "$table.readme" >"$root/README.md"
exit "$status"
