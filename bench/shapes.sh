#!/usr/bin/env bash
# Settles beds of every shape of bench/shapes.json, with walls and without, of one size and of many, and
# prints a table: how many come to rest, how they pack, and what a grain takes.
# usage: bench/shapes.sh [FOLDER [PRESET]]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root preset=${2:-balanced}
readonly folder=${1:-out/shapes}/$preset

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep >/dev/null
mkdir -p "$folder"
python3 -c 'import json, sys
sweep = json.load(open(sys.argv[1]))
del sweep["$schema"]
sweep["base"]["accuracy"] = sys.argv[2]
json.dump(sweep, open(sys.argv[3], "w"))' "$root/bench/shapes.json" "$preset" "$folder.json"
"$root/build/release/runner/grainsweep" run "$folder.json" --out "$folder" --threads 1 --quiet \
  --no-report --no-grains --tolerate-unsettled
python3 "$root/bench/shapes.py" "$folder"
