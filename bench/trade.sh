#!/usr/bin/env bash
# Measures the trade of speed for accuracy: settles the sweeps of bench/trade, 64 starts with each of
# about 30 accuracies, and compares every accuracy with exact rest, start by start. Writes trade.md,
# trade.csv and, with gnuplot, trade.svg of all scenes that FOLDER holds; --readme puts them into
# bench/README.md. Scenes take a third of an hour to three hours of one core; stopped, it goes on where it was.
# usage: bench/trade.sh [--readme] [FOLDER [SCENE...]]
# Scenes are walls, tube, two-sizes, tall, no-walls and pinacoids; none writes tables and picture alone.
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readme=
[ "${1:-}" != --readme ] || { readme=yes && shift; }
readonly root readme folder=${1:-out/trade}
shift || true
readonly all=(walls tube two-sizes tall no-walls pinacoids)
(($#)) || set -- "${all[@]}"
[ "$*" != none ] || set --

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep bench_trade >/dev/null
mkdir -p "$folder"
for scene in "$@"; do
  "$root/build/release/runner/grainsweep" run "$root/bench/trade/$scene.json" --out "$folder/$scene" \
    --threads 1 --no-grains --no-report --quiet --tolerate-unsettled
done

begun=() missing=()
for scene in "${all[@]}"; do
  if [ -e "$folder/$scene/provenance.json" ]; then begun+=("$folder/$scene"); else missing+=("$scene"); fi
done
"$root/build/release/bench/trade/bench_trade" "$folder/trade.md" "$folder/trade.csv" "${begun[@]}"
((!${#missing[@]})) || printf '\nNot settled yet: %s.\n' "${missing[*]}" >>"$folder/trade.md"
printf '%s\n' "$folder/trade.md" "$folder/trade.csv"
if command -v gnuplot >/dev/null; then
  gnuplot -c "$root/bench/trade.gnuplot" "$folder/trade.csv" "$folder/trade.svg"
  echo "$folder/trade.svg"
else
  echo "no picture: gnuplot is not installed (Debian package gnuplot-nox)" >&2
fi

if [ -n "$readme" ]; then
  python3 - "$root/bench/README.md" "$folder/trade.md" <<'PYTHON'
import sys
page, tables = (open(name, encoding="utf-8").read() for name in sys.argv[1:])
begin, end = "<!-- begin: bench/trade.sh -->\n", "<!-- end: bench/trade.sh -->\n"
before, rest = page.split(begin)
open(sys.argv[1], "w", encoding="utf-8").write(before + begin + tables + end + rest.split(end)[1])
PYTHON
  [ ! -e "$folder/trade.svg" ] || cp "$folder/trade.svg" "$root/bench/trade.svg"
fi
