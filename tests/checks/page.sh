#!/usr/bin/env bash
# report.html as people see it: browser.py opens the pages of small sweeps in Chromium - spheres
# with the labels that would do most harm, sizes instead of widths, distributions of them, polyhedra,
# one in which all packings failed, one in which none was made - and the view of one bed.
# usage: page.sh GRAINSWEEP
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
printf '{"source": "A </script> paper", "families": [{"where": {}, "values": [
  {"quantity": "Z", "width": 4, "value": 5.2, "error": 0.1}, {"quantity": "phi", "width": 5, "value": 0.6},
  {"quantity": "C", "value": [0.1, 0.3]}, {"quantity": "Z_unconfined", "value": 6, "error": 0.02}]}]}' \
  >widths.reference.json
sweep widths "$square" '{ "label": "'"$harm"'", "grid": { "box.width": [3, 4, 5] } },
  { "label": "bulk", "set": { "box.width": 5, "box.y": "periodic" } }'
sweep sizes "$square" '{ "label": "spread", "grid": { "sizes.spread": [0, 0.05, 0.1] } },
  { "label": "small", "grid": { "sizes.small_share": [0.3, 0.6], "box.width": [3, 4, 5] } }'
sweep pinacoids '"shape": "pinacoid", '"$square" '{ "label": "walls", "grid": { "box.width": [3, 4] } }'
sweep mixture '"shape": { "mixture": [ { "share": 0.5, "cube": {} }, { "share": 0.5, "sphere": {} } ] }, '"$square" '{ "label": "walls", "set": { "box.width": 5, "box.length": 5 } }'
sweep failed "$square" '{ "label": "short", "set": { "accuracy": { "preset": "fast", "max_steps": 40 } } }'
sweep empty "$square" '{ "label": "none", "grid": { "box.width": [3, 4] } }'

sweep grading "$square" '{ "label": "sieved", "grid": { "sizes.distribution": [
  { "table": { "diameters": [10, 20], "shares": [0.3, 0.7] }, "size": 20 },
  { "lognormal": { "median": 20, "sigma": 0.1 }, "size": 20 } ] } }'
sed -i 's/"replicates": 2/&, "units": { "d": 20, "unit": "mm", "density": 2650 }/' grading.json

# has_figures NAME FIGURE...: its page shows these and no others, each with all of its files.
has_figures() {
  local name=$1 figure
  shift
  for figure in "$@"; do
    for ending in svg png csv gnuplot; do
      [ -s "$name/figures/$figure.$ending" ] || fail "$name: no $figure.$ending"
    done
  done
  [ "$(find "$name/figures" -name '*.svg' | wc -l)" -eq $# ] || fail "$name: $(ls "$name/figures")"
}

fail() {
  printf 'page: %s\n' "$*" >&2
  exit 1
}

pages=()
for name in widths sizes grading pinacoids mixture failed empty; do
  "$grainsweep" run "$name.json" --quiet --out "$name" || [ $? -eq 1 ]
  pages+=("$name/report.html")
done
[ ! -e x ]
[ ! -e widths/figures/x ]
has_figures widths means profiles heights distributions effort published
has_figures sizes means profiles small_grains heights distributions effort
has_figures grading means profiles grading heights distributions effort
has_figures pinacoids means profiles contacts heights distributions effort
has_figures mixture means profiles components contacts heights distributions effort
has_figures failed effort
[ -s widths/figures/means-residuals.csv ]
cmp widths/comparison.csv <("$grainsweep" compare widths --csv) || fail "compare and report differ"
[ "$(head -1 widths/comparison.csv)" = "$("$grainsweep" columns |
  awk -F, '$1 == "comparison.csv" { printf "%s%s", sep, $2; sep = "," }')" ] ||
  fail "comparison.csv has other columns than are told"
[ "$(wc -l <widths/comparison.csv)" -eq 5 ] || fail "comparison.csv has not 4 rows"
[ ! -e sizes/comparison.csv ] || fail "without published values there is a comparison.csv"
mv widths.reference.json aside.json
cp widths/comparison.csv compared.csv
"$grainsweep" report widths 2>&1 >/dev/null | grep -q "kept in widths/reference.json: widths.reference" ||
  fail "nothing says where published values come from"
cmp widths/comparison.csv compared.csv || fail "published values are lost with their file"
cmp widths/comparison.csv <("$grainsweep" compare widths --csv 2>/dev/null) || fail "compare loses them"
rm widths/reference.json
"$grainsweep" report widths 2>&1 >/dev/null | grep -q "no published values: widths.reference.json is" ||
  fail "nothing says that published values are missing"
cmp widths/comparison.csv compared.csv || fail "comparison.csv is gone with the published values"
mv aside.json widths.reference.json
"$grainsweep" report widths >/dev/null
/usr/bin/python3 - widths <<'EOF'
import csv, json, pathlib, sys
folder = pathlib.Path(sys.argv[1])
label = json.load(open(f"{folder}.json"))["sweep"][0]["label"]
for name in ("packings", "groups", "profiles", "decays", "distributions"):
    rows = list(csv.DictReader(open(folder / f"{name}.csv", newline="")))
    assert {row["label"] for row in rows} == {label, "bulk"}, f"{name}.csv: labels are broken"
    assert None not in rows[0] and all(None not in row.values() for row in rows), f"{name}.csv: cells"
EOF
rm empty/shards/*.beds
sed -i 1q empty/shards/*.jsonl # a run that was stopped before its first packing
"$grainsweep" report empty >/dev/null
"$grainsweep" run widths.json --quiet --no-report --out without
[ ! -e without/report.html ]
[ ! -e without/figures ]

"$grainsweep" export pinacoids --format html --to views >/dev/null
views=(views/*.html)
pages+=("${views[0]}")

# Without axe-core the rest is still checked.
axe=${XDG_CACHE_HOME:-$HOME/.cache}/grainsweep-checks/node_modules/axe-core/axe.min.js
with_axe=()
[ ! -s "$axe" ] || with_axe=(--axe "$axe")

/usr/bin/python3 "$checks/browser.py" "${with_axe[@]}" "${pages[@]}"
size=$(stat -c %s widths/report.html)
((size < 8000000)) || { printf 'report.html has %s bytes\n' "$size" && exit 1; }
printf 'page: %s pages as they should be\n' "${#pages[@]}"
if ((${#with_axe[@]} == 0)); then
  printf 'SKIPPED: axe-core is not there (setup.sh --checks fetches it)\n'
  exit 77
fi
