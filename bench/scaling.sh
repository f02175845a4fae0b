#!/usr/bin/env bash
# Measures how the cost of a packing grows with the number of grains at one height, and with the
# height on one floor: CPU seconds at `balanced`, and the exponents of a straight line through their
# logarithms. A few minutes.
# usage: bench/scaling.sh [FOLDER]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root folder=${1:-out/scaling}

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep >/dev/null
mkdir -p "$folder"

# 19 grains per d^2 of floor settle 16 d high; a floor of 7.25 d by 7.25 d holds 1000 of them.
cat >"$folder/scaling.json" <<'EOF'
{
  "name": "scaling",
  "seed": 1,
  "base": { "accuracy": "balanced", "box": { "x": "periodic", "y": "periodic" } },
  "sweep": [
    { "label": "number",
      "zip": { "fill.grains": [1000, 3000, 10000, 30000, 100000],
               "box.length": [7.25, 12.56, 22.94, 39.74, 72.55],
               "box.width": [7.25, 12.56, 22.94, 39.74, 72.55] } },
    { "label": "height",
      "set": { "box.length": 12, "box.width": 12 },
      "grid": { "fill.solid_height": [5.7, 8.9, 14, 22, 45] } }
  ]
}
EOF
"$root/build/release/runner/grainsweep" run "$folder/scaling.json" --out "$folder/run" \
  --threads 1 --tolerate-unsettled >"$folder/log.txt"

# usage: exponent LABEL COLUMN NAME: cost against a column, and its exponent
exponent() {
  awk -F, -v label="$1" -v column="$2" '
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
    $at["label"] == label {
      x = $at[column]; y = $at["cpu_seconds"]
      printf "%-8s %10.4g  %8.3f s  %s\n", column, x, y, $at["status"]
      ++n; a += log(x); b += log(y); c += log(x) ^ 2; d += log(x) * log(y)
    }
    END { printf "cost grows as %s^%.2f\n\n", column, (n * d - a * b) / (n * c - a * a) }' \
    "$folder/run/packings.csv"
}
exponent number grains
exponent height surface_height
