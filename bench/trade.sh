#!/usr/bin/env bash
# Measures the trade of speed for accuracy: settles the sweeps of bench/trade, 64 or more starts with
# each of about 30 accuracies, and compares every accuracy with exact rest, start by start. Writes
# SCENE.md, SCENE.csv and, with gnuplot, SCENE.svg; --readme puts them into bench/trade/README.md, in which other
# scenes stay as they were measured. A scene takes a third of an hour to three hours of one core;
# stopped, it goes on where it was.
# usage: bench/trade.sh [--readme] [FOLDER [SCENE...]]
# Scenes are walls, tube, two-sizes, tall, no-walls and pinacoids: all of them, if none is named.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readme=
[ "${1:-}" != --readme ] || { readme=yes && shift; }
readonly root readme folder=${1:-out/trade}
shift || true
(($#)) || set -- walls tube two-sizes tall no-walls pinacoids

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep bench_trade >/dev/null
mkdir -p "$folder"
for scene in "$@"; do
  "$root/build/release/runner/grainsweep" run "$root/bench/trade/$scene.json" --out "$folder/$scene" \
    --threads 1 --no-grains --no-report --quiet --tolerate-unsettled
  "$root/build/release/bench/trade/bench_trade" "$folder/$scene" "$folder/$scene.md" "$folder/$scene.csv"
  printf '%s\n' "$folder/$scene.md" "$folder/$scene.csv"
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
