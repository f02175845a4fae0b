#!/usr/bin/env bash
# The gnuplot scripts of configs/ draw every value of a small sweep's tables, without a warning.
# usage: pictures.sh GRAINSWEEP
set -euo pipefail
grainsweep=$(realpath "${1:?usage: pictures.sh GRAINSWEEP}")
configs=$(realpath "$(dirname "$0")/../../configs")
readonly grainsweep configs
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-pictures.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

if ! command -v gnuplot >/dev/null; then
  printf 'SKIPPED: gnuplot is not installed\n'
  exit 77
fi
fail() {
  printf 'pictures: %s\n' "$1" >&2
  exit 1
}

cat >sweep.json <<'JSON'
{ "name": "sweep", "replicates": 2,
  "base": { "box": { "length": 4 }, "fill": { "solid_height": 4 }, "accuracy": "fast",
            "measure": { "exclude_floor": 1, "exclude_surface": 1 } },
  "sweep": [ { "label": "walls", "grid": { "box.width": [4, 5, 6] } },
             { "label": "bulk", "set": { "box.width": 6, "box.y": "periodic" } },
             { "label": "tubes", "grid": { "tube.diameter": [3.2, 4] } } ] }
JSON
"$grainsweep" run sweep.json --quiet --out out

# expect_points PICTURE MARK COUNT: how many symbols of a kind gnuplot drew, the key's too. Beneath
# points with bars it draws white ones.
expect_points() {
  local drawn
  drawn=$(grep "<use xlink:href='#$2' transform" "$1" | grep -vc '#FFFFFF' || true)
  [ "$drawn" -eq "$3" ] || fail "$1 has $drawn points $2, expected $3"
}

for script in "$configs"/*.gnuplot; do
  picture=$(basename "$script" .gnuplot).svg
  gnuplot -c "$script" out "$picture" 2>said || fail "$script: $(cat said)"
  [ ! -s said ] || fail "$script: $(cat said)"
done
expect_points wall-effect.svg gpPt6 8   # in two plots three widths and the key
expect_points wall-effect.svg gpPt4 4   # and the value without walls
expect_points porosity.svg gpPt6 3      # two tubes and the key
expect_points gap-tolerance.svg gpPt6 9 # two packings at four gaps
line=$(awk -F, '$2 == "coordination" && $3 == "determined" { printf "%.3f - %.2f d / W", $8, $10 }' out/fits.csv)
[ -n "$line" ] || fail "fits.csv has no line of Z"
grep -qF -- "$line" wall-effect.svg || fail "the line of wall-effect.svg is not that of fits.csv"
# Nor does it erase anything about the points of figures.
white=$(grep -h "<use xlink:href=.*'#FFFFFF'" out/figures/*.svg | grep -vc 'scale(0\.00)' || true)
[ "$white" -eq 0 ] || fail "figures have $white white points"
printf 'pictures: all scripts of configs/ draw what the tables hold\n'
