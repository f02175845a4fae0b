#!/usr/bin/env bash
# Tables and picture of the trade come from the output folder of a small sweep, whole or not.
# usage: texts.sh GRAINSWEEP BENCH_TRADE SOURCES        (bench/trade in the sources)
set -euo pipefail
grainsweep=$(realpath "$1") trade=$(realpath "$2") sources=$(realpath "$3")
source "$sources/../text_test.sh"

cat >small.json <<'JSON'
{ "name": "small", "replicates": 2,
  "base": { "box": { "length": 4, "width": 4 }, "fill": { "grains": 80 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 } },
  "sweep": [ { "label": "small, W = 4", "grid": { "accuracy": [
    "exact", "fast", "balanced", { "preset": "exact", "rest": "in_steps" }, { "preset": "fast", "step": 0.28 } ] } } ] }
JSON
"$grainsweep" run small.json --out small --threads 1 --no-grains --no-report --quiet --tolerate-unsettled
"$trade" small trade.md trade.csv
grep -qF '**small, W = 4**. Reference: `exact`' trade.md || fail "no heading of the scene"
grep -qF '| fast, step 0.28 |' trade.md || fail "no row of the changed part"
grep -qF '| `exact, rest in_steps` |' trade.md || fail "no row of what exact rest changes"
[ "$(wc -l <trade.csv)" -eq 6 ] || fail "trade.csv has not five rows"
if grep -qF 'not finished' trade.md; then fail "a whole scene is said not to be"; fi

sed 's/"name": "small"/"name": "small", "seed": 2/' small.json >other.json
"$grainsweep" run other.json --out other --threads 1 --no-grains --no-report --quiet --tolerate-unsettled
"$trade" small trade.md trade.csv pool.json
"$trade" other trade.md trade.csv pool.json
grep -qF '| **balanced** | 4 | 4 of 4 |' trade.md || fail "starts of two seeds are not told as four"

sed 's/"name": "small"/"name": "small", "seed": 3/; s/"exact", "fast".*/"exact" ] } } ] }/' small.json >reference.json
"$grainsweep" run reference.json --out reference --threads 1 --no-grains --no-report --quiet --tolerate-unsettled
"$trade" reference trade.md trade.csv pool.json
"$trade" small trade.md trade.csv pool.json
grep -qF 'these are of 6 starts' trade.md || fail "the starts that the reference has in addition are not told"
grep -qF '| fast, step 0.28 | 4 | 4 of 4 |' trade.md || fail "rows without these starts are not told of four"

sed 's/"replicates": 2/"replicates": 3/' small.json >more.json
"$grainsweep" run more.json --out small --shard 1/2 --no-grains --no-report --quiet --tolerate-unsettled
"$trade" small trade.md trade.csv
grep -qE 'not finished: 1[0-4] of 15 packings are made' trade.md || fail "what lacks is not said"

if "$trade" nowhere trade.md trade.csv 2>message; then fail "a folder that is none was read"; fi
grep -qF 'nowhere' message || fail "the message does not name the folder"

command -v gnuplot >/dev/null || { echo "SKIPPED: gnuplot is not installed" && exit 77; }
gnuplot -c "$sources/../trade.gnuplot" trade.csv trade.svg 2>message
[ ! -s message ] || fail "gnuplot warns: $(cat message)"
for text in 'small, W = 4' balanced fast exact; do
  grep -qF ">$text<" trade.svg || fail "the picture does not say $text"
done
