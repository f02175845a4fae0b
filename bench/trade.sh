#!/usr/bin/env bash
# Measures the trade of speed for accuracy: settles the sweeps of bench/trade, 64 or more starts with
# each of 24 to 27 accuracies, and compares every accuracy with exact rest, start by start. Writes
# SCENE.md, SCENE.csv and, with gnuplot, SCENE.svg; --readme puts them into bench/trade/README.md, in which other
# scenes stay as they were measured. A scene takes a third of an hour to three hours of one core;
# stopped, it goes on where it was.
# --seed N makes other starts, those of seed N: tables then tell the means of all seeds whose rows stand in
# bench/trade/SCENE.seeds.json, to which those of N are added; what the search for exact rest changes is told of
# N alone. Remove that file where beds pack otherwise than when it was made. --first K settles them with the
# first K accuracies alone, the reference being the first: it can have more starts than the others, which helps
# where pairs do not (see bench/trade/README.md). The tables are then of these accuracies.
# usage: bench/trade.sh [--readme] [--seed N [--first K]] [FOLDER [SCENE...]]
# Scenes are walls, tube, two-sizes, tall, no-walls and pinacoids: all of them, if none is named.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readme= seed= first=
[ "${1:-}" != --readme ] || { readme=yes && shift; }
[ "${1:-}" != --seed ] || { seed=$2 && shift 2; }
[ "${1:-}" != --first ] || { first=$2 && shift 2; }
[ -z "$first" ] || { [ -n "$seed" ] && [ -z "$readme" ]; } ||
  { echo "trade.sh: --first needs --seed, and leaves the README alone" >&2 && exit 2; }
readonly root readme seed first folder=${1:-out/trade}
shift || true
(($#)) || set -- walls tube two-sizes tall no-walls pinacoids

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep bench_trade >/dev/null
mkdir -p "$folder"
for scene in "$@"; do
  sweep=$root/bench/trade/$scene.json beds=$folder/$scene pool=()
  if [ -n "$seed" ]; then
    sweep=$folder/$scene-$seed.json beds=$folder/$scene-$seed pool=("$root/bench/trade/$scene.seeds.json")
    python3 -c 'import json, sys
sweep = json.load(open(sys.argv[1]))
del sweep["$schema"]
sweep["seed"] = int(sys.argv[2])
grid = sweep["sweep"][0]["grid"]
grid["accuracy"] = grid["accuracy"][:int(sys.argv[4]) if sys.argv[4] else None]
json.dump(sweep, open(sys.argv[3], "w"), indent=1)' "$root/bench/trade/$scene.json" "$seed" "$sweep" "$first"
  fi
  "$root/build/release/runner/grainsweep" run "$sweep" --out "$beds" \
    --threads 1 --no-grains --no-report --quiet --tolerate-unsettled
  "$root/build/release/bench/trade/bench_trade" "$beds" "$folder/$scene.md" "$folder/$scene.csv" "${pool[@]}"
  printf '%s\n' "$folder/$scene.md" "$folder/$scene.csv"
  rm -f "$folder/$scene.svg" # an earlier one would stand beside other tables
  if command -v gnuplot >/dev/null; then
    gnuplot -c "$root/bench/trade.gnuplot" "$folder/$scene.csv" "$folder/$scene.svg"
    echo "$folder/$scene.svg"
  else
    echo "no picture: gnuplot is not installed (Debian package gnuplot-nox)" >&2
  fi
  [ -n "$readme" ] || continue
  python3 - "$root/bench/trade/README.md" "$folder/$scene.md" "$scene" <<'PYTHON'
import sys
page, tables = (open(name, encoding="utf-8").read() for name in sys.argv[1:3])
begin, end = (f"<!-- {place}: bench/trade.sh, {sys.argv[3]} -->\n" for place in ("begin", "end"))
before, rest = page.split(begin)
open(sys.argv[1], "w", encoding="utf-8").write(before + begin + tables + end + rest.split(end)[1])
PYTHON
  [ ! -e "$folder/$scene.svg" ] || cp "$folder/$scene.svg" "$root/bench/trade/$scene.svg"
done
