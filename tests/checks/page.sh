#!/usr/bin/env bash
# report.html as people see it: browser.py opens the pages of small sweeps in Chromium - spheres with
# the labels that would do most harm, sizes instead of widths, polyhedra, one that all failed, one of
# which nothing was made - and the view of one bed. usage: page.sh GRAINSWEEP
set -euo pipefail
grainsweep=$(realpath "${1:?usage: page.sh GRAINSWEEP}")
checks=$(realpath "$(dirname "$0")")
readonly grainsweep checks
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-page.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"

for program in chromium gnuplot python3; do
  if ! command -v "$program" >/dev/null; then
    printf 'SKIPPED: %s is not installed (setup.sh --checks installs it)\n' "$program"
    exit 77
  fi
done

# sweep NAME BASE BLOCKS: writes NAME.json.
sweep() {
  printf '{ "name": "%s", "replicates": 2, "base": { "accuracy": "fast",
    "measure": { "exclude_floor": 1, "exclude_surface": 1 }, "fill": { "solid_height": 4 }, %s },
    "sweep": [ %s ] }\n' "$@" >"$1.json"
}
readonly square='"box": { "length": 4, "width": 4 }'
harm='</script><script>alert(1)</script><img src=x onerror=alert(1)>\"q\"'\'', `touch x`{{title}}%s'
sweep widths "$square" '{ "label": "'"$harm"'", "grid": { "box.width": [3, 4, 5] } },
  { "label": "bulk", "set": { "box.width": 5, "box.y": "periodic" } }'
sweep sizes "$square" '{ "label": "spread", "grid": { "sizes.spread": [0, 0.05, 0.1] } },
  { "label": "small", "grid": { "sizes.small_share": [0.3, 0.6], "box.width": [3, 4, 5] } }'
sweep pinacoids '"shape": "pinacoid", '"$square" '{ "label": "walls", "grid": { "box.width": [3, 4] } }'
sweep failed "$square" '{ "label": "short", "set": { "accuracy": { "preset": "fast", "max_steps": 40 } } }'
sweep empty "$square" '{ "label": "none", "grid": { "box.width": [3, 4] } }'

pages=()
for name in widths sizes pinacoids failed empty; do
  "$grainsweep" run "$name.json" --quiet --out "$name" || [ $? -eq 1 ]
  pages+=("$name/report.html")
done
[ ! -e x ] && [ ! -e widths/figures/x ]
rm empty/journal-*.jsonl empty/states/*
"$grainsweep" report empty >/dev/null
"$grainsweep" run widths.json --quiet --no-report --out without
[ ! -e without/report.html ] && [ ! -e without/figures ]

"$grainsweep" export pinacoids --format html --to views >/dev/null
views=(views/*.html)
pages+=("${views[0]}")

/usr/bin/python3 "$checks/browser.py" "${pages[@]}"
size=$(stat -c %s widths/report.html)
((size < 8000000)) || { printf 'report.html has %s bytes\n' "$size" && exit 1; }
printf 'page: %s pages as they should be\n' "${#pages[@]}"
