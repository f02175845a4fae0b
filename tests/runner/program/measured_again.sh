# What is measured of a sweep changes: beds are measured again, not packed, and every table is that of
# a run that packs them so from the start.
source "$(dirname "$0")/common.sh" "$1"

# write_measured FILE MEMBERS_OF_MEASURE
write_measured() {
  cat >"$1" <<JSON
{ "name": "measured", "replicates": 2,
  "base": { "box": { "length": 4.5, "width": 4 }, "fill": { "solid_height": 4 }, "accuracy": "fast",
            "measure": { $2 } },
  "sweep": [ { "label": "one size" },
             { "label": "two sizes", "set": { "sizes": { "size_ratio": 0.5, "small_share": 0.3 } } },
             { "label": "tube", "set": { "tube": { "diameter": 4 },
                 "sizes": { "distribution": { "by": "number", "uniform": { "from": 0.7, "to": 1.2 } } } } },
             { "label": "turned", "set": { "shape": { "pinacoid": { "height": 0.7 } } } },
             { "label": "prisms in a tube", "set": { "shape": { "prism": { "sides": 6 } }, "tube.diameter": 4 } },
             { "label": "mixed", "set": { "shape": { "mixture": [ { "sphere": {}, "share": 0.5 },
                 { "cuboid": { "height": 0.8 }, "share": 0.5 } ] } } } ] }
JSON
}

# All that a run writes but what it took.
tables_of() {
  local table
  for table in "$1"/*.csv; do
    echo "== $(basename "$table")"
    cat "$table"
  done | /usr/bin/python3 -c '
import csv, sys
left_out = set()
for row in csv.reader(sys.stdin):
    if "cpu_seconds" in row: left_out = {k for k, name in enumerate(row) if name.startswith("cpu_seconds")}
    if row and row[0].startswith("=="): left_out = set()
    print([value for k, value in enumerate(row) if k not in left_out])'
}

write_measured before.json '"exclude_floor": 1, "exclude_surface": 1'
write_measured after.json \
  '"exclude_floor": 0.7, "exclude_surface": 1.2, "bin_width": 0.25, "gap_tolerances": [1e-3, 1e-5]'
# A bed that is measured in several ways is packed once, and planned so.
/usr/bin/python3 -c 'import json
sweep = json.load(open("before.json"))
for name, widths in ("once", [0.1]), ("often", [0.1, 0.2, 0.25, 0.3]):
    sweep["sweep"] = [{"grid": {"measure.bin_width": widths}}]
    json.dump(sweep, open(name + ".json", "w"))'
for sweep in once often; do "$program" plan "$sweep.json" --json >"$sweep.plan"; done
/usr/bin/python3 -c 'import json
once, often = (json.load(open(name + ".plan"))["left_estimated_cpu_seconds"] for name in ("once", "often"))
assert once < often < 2 * once, (once, often)'

expect_code 0 "$program" run before.json --out both --no-report --tolerate-unsettled
expect_code 0 "$program" run after.json --out fresh --no-report --tolerate-unsettled
expect_code 0 "$program" plan after.json --out both
expect_text error.txt "12 packings left, 12 of stored beds, to be measured again"
expect_code 0 "$program" run after.json --out both --no-report --tolerate-unsettled
expect_text error.txt "12 packings have the beds of stored ones, which are measured again" \
  "12 stored packings are of another sweep or of another form of this one: kept, but in no table"
[ "$(grep -c ', measured again$' error.txt)" -eq 12 ] || fail "not all were measured again: $(cat error.txt)"
tables_of fresh >fresh.txt
diff fresh.txt <(tables_of both) >&2 || fail "beds measured again have other values"
[ "$(wc -l <fresh.txt)" -gt 100 ] || fail "there are hardly any tables to compare"
beds_in fresh >beds.txt
cmp beds.txt <(beds_in both | grep -F -f <(cut -d " " -f 1 beds.txt)) || fail "other beds are stored"

# Within one sweep a bed is packed once, whatever is measured of it.
cat >several.json <<JSON
{ "name": "several", "base": { "box": { "length": 4, "width": 4 }, "fill": { "solid_height": 4 },
  "accuracy": "fast", "measure": { "exclude_floor": 1 } },
  "sweep": [ { "replicates": 2, "grid": { "measure.exclude_surface": [0.5, 1, 1.5] } } ] }
JSON
expect_code 0 "$program" run several.json --out once --no-report --tolerate-unsettled
[ "$(grep -c ', measured again$' error.txt)" -eq 4 ] || fail "not packed once: $(cat error.txt)"
expect_code 0 "$program" run several.json --out each --no-grains --no-report --tolerate-unsettled
if grep -q "measured again" error.txt; then fail "beds without grains were measured again"; fi
diff <(tables_of each) <(tables_of once) >&2 || fail "beds packed once have other values"

# Back again: all are there. Grains that were not stored are packed anew.
expect_code 0 "$program" run before.json --out both --no-report --tolerate-unsettled
[ "$(packing_lines both | wc -l)" -eq 24 ] || fail "something was made twice"
expect_code 0 "$program" run before.json --out bare --no-grains --no-report --tolerate-unsettled
expect_code 0 "$program" run after.json --out bare --no-report --tolerate-unsettled
if grep -q "measured again" error.txt; then fail "beds without grains were measured again"; fi
diff fresh.txt <(tables_of bare) >&2 || fail "packings made anew have other values"

# With more steps at most, packings that have settled stay as they are.
steps_at_most() { sed "s/\"accuracy\": \"fast\"/\"accuracy\": { \"preset\": \"fast\", \"max_steps\": $1 }/" before.json >steps.json; }
steps_at_most 420
expect_code 0 "$program" run steps.json --out steps --no-report --tolerate-unsettled
settled="$(grep -c '"status":"settled"' <(packing_lines steps))"
[ "$settled" -gt 0 ] && [ "$settled" -lt 12 ] || fail "$settled of 12 settled in 420 steps"
steps_at_most 20000
expect_code 0 "$program" run steps.json --out steps --no-report --tolerate-unsettled
[ "$(grep -c ', measured again$' error.txt)" -eq "$settled" ] || fail "others were packed anew: $(cat error.txt)"
expect_code 0 "$program" run steps.json --out at_once --no-report --tolerate-unsettled
diff <(tables_of at_once) <(tables_of steps) >&2 || fail "beds that had settled have other values"

# A bed that is not sound is packed anew, and not said to be measured.
cp -r once cut && truncate -s 100 cut/shards/1-of-1.beds
sed 's/\[0.5, 1, 1.5\]/[0.7]/' several.json >another.json
expect_code 0 "$program" run another.json --out once --no-report --tolerate-unsettled
expect_text error.txt "2 packings have the beds of stored ones"
expect_code 0 "$program" run another.json --out cut --no-report --tolerate-unsettled
if grep -q "of stored ones\|measured again" error.txt; then fail "cut beds were measured: $(cat error.txt)"; fi
diff <(tables_of once) <(tables_of cut) >&2 || fail "beds packed anew have other values"

# Where the first packing of a bed is too low to be measured, the others are packed.
sed 's/\[0.5, 1, 1.5\]/[5.5, 1, 0.5]/' several.json >low.json
expect_code 1 "$program" run low.json --out low --no-report
[ "$(grep -c ',failed,.*the bed is too low' low/packings.csv)" -eq 2 ] || fail "not two are too low"
[ "$(grep -c ',settled,' low/packings.csv)" -eq 4 ] || fail "the others were not packed"
expect_code 1 "$program" run low.json --out low --no-report --retry-failed
[ "$(grep -c '^[0-9]/6  ' error.txt)" -eq 2 ] || fail "other packings than those that failed were made"
