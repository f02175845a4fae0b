#!/usr/bin/env bash
# Maps where settling is right over step and residual tolerance, and writes stability-map.csv and,
# with gnuplot, stability-map.svg. About five minutes. usage: bench/stability_map.sh [FOLDER] [GRAINS] [STARTS]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root folder=${1:-out/stability} grains=${2:-500} starts=${3:-4}

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target bench_stability_map >/dev/null
mkdir -p "$folder"
"$root/build/release/bench/bench_stability_map" "$grains" "$starts" >"$folder/stability-map.csv"
echo "$folder/stability-map.csv"
if command -v gnuplot >/dev/null; then
  gnuplot -c "$root/bench/stability_map.gnuplot" "$folder/stability-map.csv" "$folder/stability-map.svg"
  echo "$folder/stability-map.svg"
else
  echo "no picture: gnuplot is not installed (Debian package gnuplot-nox)" >&2
fi
