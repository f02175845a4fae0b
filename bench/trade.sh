#!/usr/bin/env bash
# Measures the trade of speed for accuracy: settles the same starts with one part of the accuracy
# changed at a time, and writes trade.csv and, with gnuplot, trade.svg. About ten minutes.
# usage: bench/trade.sh [FOLDER] [GRAINS] [STARTS]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root folder=${1:-out/trade} grains=${2:-2000} starts=${3:-3}

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target bench_trade >/dev/null
mkdir -p "$folder"
"$root/build/release/bench/bench_trade" "$grains" "$starts" >"$folder/trade.csv"
echo "$folder/trade.csv"
if command -v gnuplot >/dev/null; then
  gnuplot -c "$root/bench/trade.gnuplot" "$folder/trade.csv" "$folder/trade.svg"
  echo "$folder/trade.svg"
else
  echo "no picture: gnuplot is not installed (Debian package gnuplot-nox)" >&2
fi
