# Folders of different runners become one, with the tables of a single run; nothing enters twice.
source "$(dirname "$0")/common.sh" "$1"
write_sweep sweep.json 2
grep -v '"bulk"' sweep.json | sed 's/6\] } },/6] } } ] }/' >walls.json

run_all() { # FILE FOLDER
  local code=0
  "$program" run "$1" --threads 2 --out "$2" --quiet --no-report || code=$?
  [ "$code" -le 1 ] || fail "run ended with $code"
}

# merge FOLDER... --out FOLDER: without figures, which take longer than all the rest.
merge() {
  expect_code 0 env PATH=none "$program" collect "$@"
}

# `part` holds the first three packings of the journal of `whole`, as if it had been stopped.
run_all sweep.json whole
mkdir part
mkdir part/shards
cp whole/provenance.json part
cp whole/shards/1-of-1.beds part/shards/2-of-5.beds
packing_lines whole | head -n 3 >part/shards/2-of-5.jsonl
run_all walls.json walls

expect_code 0 "$program" collect part walls --out all
expect_text out.txt "packings added to all, which now holds" "Page to look at: all/report.html"
expect_text all/report.html "$(cut -d, -f1 walls/packings.csv | tail -n 1)" "</html>"
expect_code 0 "$program" status all --json
packed=$({ packing_lines part && packing_lines walls; } | sed 's/.*"job":"\([0-9a-f]*\)".*/\1/' |
  sort -u | wc -l)
expect_text out.txt '"packings": 10' "\"pending\": $((10 - packed))"
[ "$(packing_lines all | wc -l)" -eq "$packed" ] || fail "not one line per packing"

# Again: nothing is added, nothing changes. What is missing comes from the last folder.
cp all/provenance.json before.json
merge part walls --out all
expect_text out.txt "0 packings added"
cmp before.json all/provenance.json || fail "collecting again changed the record"
[ "$(grep -c '"text": ' all/provenance.json)" -eq 2 ] || fail "not both sweeps were kept"
merge whole --out all
expect_text out.txt "which now holds 10 of 10"
[ "$(packing_lines all | wc -l)" -eq 10 ] || fail "not one line per packing"
[ "$(values_of all | sort)" = "$(values_of whole | sort)" ] || fail "other values after collect"
cmp whole/groups.csv all/groups.csv || fail "other groups after collect"
cmp <(beds_in whole) <(beds_in all) || fail "other grains after collect"

# A folder of one sweep can be gone on with, and a damaged bed is made again.
merge whole --out copy
job=$(sed -n 2p whole/packings.csv | cut -d, -f1)
damage_bed whole "$(packing_lines whole | grep "$job")" 50
expect_code 4 env PATH=none "$program" collect whole --out mended
expect_text error.txt "whole/shards/1-of-1.beds: packing $job: damaged"
expect_text out.txt "now holds 9 of 10"
run_all sweep.json mended
cmp <(values_of copy) <(values_of mended) || fail "other values after going on"

# Refused: no output folder, the folder itself, none to merge into.
expect_code 2 "$program" collect whole nowhere --out fresh
expect_text error.txt "nowhere" "no output folder"
[ ! -e fresh ] || fail "a refused collect wrote something"
expect_code 2 "$program" collect whole ./all --out all
expect_text error.txt "./all: is the folder given with --out"
expect_code 2 "$program" collect whole
echo "folders are merged"
