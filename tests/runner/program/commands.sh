# A small sweep from file to tables, and every command on its results.
configs=$(realpath "$(dirname "$0")/../../../configs")
source "$(dirname "$0")/common.sh" "$1"
write_sweep small.json 2

expect_code 0 "$program" --help
expect_text out.txt "run" "export" "Exit codes"
expect_code 0 "$program" --version
expect_code 0 "$program" validate small.json
expect_text out.txt "right: 10 packings, 5 parameter sets"
expect_code 0 "$program" plan small.json --threads 2
expect_text out.txt "10 packings" "bulk" "2 threads" "height/d" "Estimated: "
if grep -q "height/mm" out.txt; then fail "heights are in mm, which the sweep does not name"; fi
expect_code 0 "$program" plan small.json --json
expect_text out.txt '"packings": 10' '"estimated_bytes"' '"available_bytes"' '"left_packings": 10' \
  '"expected_height":'
[ "$(grep -c '"job":"[0-9a-f]*",.*"parameters":{"accuracy".*}' out.txt)" -eq 10 ] || fail "not 10 jobs"
cp out.txt plan.json
printf '%s\n' '{"name": "asked", "base": {"accuracy": {"coordination": 0.1}}}' >asked.json
for command in validate plan; do
  expect_code 0 "$program" "$command" asked.json
  expect_text out.txt 'of 1 parameter set of spheres of one size: "fast"' "bounds: 0.003 in solid fraction"
done
expect_code 0 "$program" schema
expect_text out.txt '"$schema"' '"small_share"'
expect_code 0 "$program" columns
expect_text out.txt "packings.csv,solid_fraction,," "decays.csv,lambda,d,"
expect_code 0 "$program" columns --markdown
expect_text out.txt '| `overlap_mean` | d | '
expect_code 0 "$program" doctor
expect_text out.txt "sse2" "cores" "oneTBB" "figures  "
mkdir no-programs
expect_code 0 env PATH="$here/no-programs" "$program" doctor
expect_text out.txt "figures           no gnuplot: pages have no figures (Debian: apt-get install"
expect_code 4 bash -c 'mkdir gone && cd gone && rmdir ../gone && exec "$0" doctor' "$program"
expect_text out.txt "writing here      fails: "
[ ! -e out ] || fail "looking wrote something"

# Whether such small beds all settle is not the point here: 0 and 1 both end a run.
code=0
"$program" run small.json >report.txt 2>progress.txt || code=$?
[ "$code" -le 1 ] || fail "run ended with $code: $(cat progress.txt)"
expect_text report.txt "small: 10 packings" "walls" "5 periodic" "Tables in out/small" "CPU time"
expect_text progress.txt "10/10  "
for file in packings.csv groups.csv fits.csv fit_points.csv profiles.csv decays.csv \
  distributions.csv sizes.csv components.csv component_profiles.csv columns.csv provenance.json; do
  [ -s "out/small/$file" ] || fail "no $file"
done
expect_text out/small/provenance.json "run small.json" '"processor": "' '"commit": "' \
  '"file": "small.json"' '\"label\": \"walls\"'
[ "$(wc -l <out/small/packings.csv)" -eq 11 ] || fail "packings.csv has not 10 rows"
[ "$(wc -l <out/small/groups.csv)" -eq 6 ] || fail "groups.csv has not 5 rows"
[ "$(wc -l <out/small/fits.csv)" -eq 3 ] || fail "fits.csv has not 2 rows"
[ -z "$(find out -name '*.tmp.*')" ] || fail "temporary files are left"

cp -r out/small before
rm out/small/*.csv # as after a hard kill
expect_code 0 env PATH="$here/no-programs" "$program" report out/small
cmp out.txt report.txt || fail "report prints another table than run"
for table in before/*.csv; do
  cmp "$table" "out/small/${table##*/}" || fail "report writes another table than run"
done
rm -r before
[ "$(grep -c gnuplot error.txt)" -eq 1 ] || fail "not told once: $(cat error.txt)"
expect_text out/small/report.html "for want of gnuplot" "</html>"
rm out/small/report.html && mkdir -p out/small/report.html/in-the-way
expect_code 4 "$program" report out/small
expect_text error.txt "there is no new page: "
cmp out.txt <(grep -v "^Page to look at" report.txt) || fail "without a page report prints another table"
rm -r out/small/report.html
mv out/small/fits.csv fits.csv && mkdir -p out/small/fits.csv/in-the-way
expect_code 4 "$program" report out/small
expect_text error.txt "there are no new tables: "
if grep -q "^Tables in" out.txt; then fail "tables are said to be there that are not"; fi
rm -r out/small/fits.csv && mv fits.csv out/small/fits.csv
expect_code 2 "$program" compare out/small
expect_text error.txt "small.reference.json" "--with FILE, such as paper-spheres.reference.json in the folder"
printf '{"source": "A paper", "families": [{"where": {}, "values": [{"quantity": "Z", "width": 99, "value": 6}]}]}' \
  >small.reference.json
expect_code 0 "$program" compare out/small
expect_text out.txt "A paper" "not determined: this family has no packings between walls at W = 99 d"
printf '{"source": 1}' >small.reference.json
for command in validate plan "run --out again --no-report"; do
  # shellcheck disable=SC2086  # a command and its options
  "$program" $command small.json >out.txt 2>error.txt || [ $? -eq 1 ]
  expect_text error.txt "note: the page will have no published values: small.reference.json:1:1: needs"
done
rm -r small.reference.json again
for reference in "$configs"/*.reference.json; do
  expect_code 0 "$program" compare out/small --with "$reference"
  expect_text out.txt "beside small. Lengths in d."
done

# Lengths of published values are in d, not in the unit of the sweep.
sed 's/"seed": 3/"seed": 3, "units": { "d": 5, "unit": "mm" }/' small.json >units.json
cp -r out/small units
expect_code "$code" "$program" run units.json --out units --no-report
printf '{"source": "A paper", "common": [], "families": [{"where": {}, "values": [%s, %s, %s]}]}' \
  '{"quantity": "Z", "width": 20, "value": 6}' '{"quantity": "Z", "width": 4, "value": 6}' \
  '{"quantity": "Z", "width": 99, "value": 6}' >units.reference.json
expect_code 0 "$program" compare units
expect_text error.txt "note: no packing has the width 20 d; widths are in d, and 20 mm is 4 d"
[ "$(grep -c "no packing has the width" error.txt)" -eq 1 ] || fail "compare notes $(cat error.txt)"
expect_code 0 "$program" plan units.json
expect_text out.txt "height/d  height/mm"
if grep -E '^.{101}' <(grep "height/d" -A 5 out.txt); then fail "the table of plan is wider than 100 characters"; fi
rm -r units units.reference.json

# The plan has the parameter sets of a family together, however the grid is written.
printf '{"name": "grid", "sweep": [{"label": "two sizes", "grid": {%s}}]}' \
  '"box.width": [4, 5], "sizes.small_share": [0, 0.25]' >grid.json
expect_code 0 "$program" plan grid.json
[ "$(grep -c "two sizes small_share=0$" out.txt)" -eq 1 ] || fail "plan lists a family in parts: $(cat out.txt)"

# A bed of 110 GB: validate warns where plan does.
cat >large.json <<'JSON'
{ "name": "large", "replicates": 1,
  "base": { "shape": { "prism": { "sides": 200 } }, "fill": { "grains": 10000000 }, "box": { "length": 300, "width": 300 } } }
JSON
expect_code 0 "$program" plan large.json
sed 's/, and .* can be had here//' error.txt >planned.txt
expect_code 0 "$program" validate large.json
sed 's/, and .* can be had here//' error.txt | cmp - planned.txt || fail "validate says of memory $(cat error.txt)"

expect_code 0 "$program" status out/small
expect_text out.txt "10 of 10 packings done" "No runner at work"
expect_code 0 "$program" plan small.json --out out/small --shards 3
expect_text error.txt "10 packings made in out/small: estimates times " "; 0 packings left, about 0.00 s CPU"
expect_text out.txt "Left: nothing, all of them are made" "No cluster is needed." "In 3 shards: about "
expect_code 0 "$program" plan small.json --out out/small --json
expect_text out.txt '"packings": 10' '"left_packings": 0' '"left_estimated_cpu_seconds": 0.0' \
  '"left_estimated_wall_seconds": 0.0'
sed 's/"replicates": *2/"replicates": 3/' small.json >more.json
expect_code 0 "$program" plan more.json --out out/small
expect_text out.txt "15 packings" "Left: 5 of 15 packings, " " CPU, about "
expect_code 0 "$program" plan small.json --out out/smal
expect_text error.txt "No packing is made in out/smal: there is no such folder"
expect_code 0 "$program" status out/small --json
expect_text out.txt '"packings": 10' '"pending": 0' '"runners": []' '"sweep_file": "small.json"'

"$program" run small.json --out bare --no-grains --no-report --quiet
for table in profiles decays distributions; do
  cmp "out/small/$table.csv" "bare/$table.csv" || fail "without grains there are other $table"
done
expect_code 2 "$program" export bare
expect_text error.txt "bare: 10 packings to export, stored without grains; " " --with-grains makes them again"
expect_code 2 "$program" export bare --job "$(sed -n 2p bare/packings.csv | cut -c1-16)"
expect_text error.txt "bare: 1 packing to export, stored without grains"

# One packing alone is that of the whole sweep, bit by bit; so are those made again with grains.
job=$(sed -n 3p out/small/packings.csv | cut -d, -f1)
"$program" run small.json --out alone --no-report --job "${job:0:8}" >out.txt 2>error.txt || [ $? -eq 1 ]
cmp <(values_of alone | grep "^$job") <(values_of out/small | grep "^$job") || fail "--job makes another packing"
[ "$(packing_lines alone | wc -l)" -eq 1 ] || fail "--job made others"
cmp <(beds_in alone) <(beds_in out/small | grep "^$job") || fail "--job makes another bed"
expect_code 2 "$program" run small.json --out alone --job nosuchjob
expect_text error.txt "--job nosuchjob: no such packing"
expect_code 2 "$program" run small.json --out alone --job "$job" --fresh --yes
expect_code 2 "$program" run small.json --out alone --job "$job" --shard 1/2
"$program" run small.json --out bare --no-report >out.txt 2>error.txt || [ $? -eq 1 ]
expect_text error.txt "note: 10 packings are stored without grains; " "run small.json --out bare --with-grains"
"$program" run small.json --out bare --no-report --with-grains --job "$job" >out.txt 2>error.txt || [ $? -eq 1 ]
expect_text error.txt "note: 9 packings are stored without grains"
expect_code 0 "$program" export bare --format xyz
expect_text out.txt "1 packing written" "9 packings left out: stored without grains; " "--with-grains"
[ "$(wc -l <error.txt)" -eq 1 ] || fail "a line for each packing without grains: $(cat error.txt)"
"$program" run small.json --out bare --no-report --with-grains --quiet || [ $? -eq 1 ]
cmp <(beds_in bare) <(beds_in out/small) || fail "--with-grains makes other beds"
cmp <(values_of bare) <(values_of out/small) || fail "--with-grains makes other values"

# What the plan says of the disk is about what the beds take.
planned=$(sed -n 's/.*"estimated_disk_bytes": \([0-9]*\).*/\1/p' plan.json)
taken=$(cat out/small/shards/*.beds out/small/shards/*.jsonl | wc -c)
((planned > taken * 3 / 4 && planned < taken * 4 / 3)) || fail "$planned bytes planned, $taken taken"
expect_code 0 "$program" plan small.json
expect_text out.txt "On the disk: about " " of it with --no-grains"

# Files of others are not replaced.
mkdir foreign && echo mine | tee foreign/packings.csv >foreign/report.html
for command in "run small.json" "collect out/small"; do
  expect_code 2 "$program" $command --out foreign
  expect_text error.txt "foreign: holds packings.csv, report.html, though it is no output folder"
done
[ "$(ls foreign | wc -l) $(cat foreign/packings.csv)" = "2 mine" ] || fail "files of others were touched"

# Off a cluster the scripts are printed if the options decide.
expect_code 0 env PATH="$here/no-programs" "$program" slurm small.json --print --shards 4 --threads 8
expect_text out.txt "#SBATCH --array=1-4" "#SBATCH --cpus-per-task=8"
expect_text error.txt "note: no cluster answers here: --shards and --threads decide"
if grep -q -e --partition -e --mem out.txt; then fail "the script asks for what no option says"; fi
expect_code 2 env PATH="$here/no-programs" "$program" slurm small.json --print
expect_text error.txt "sinfo: not found; " "give --shards and --threads"
mkdir asleep && printf '#!/bin/sh\necho sinfo: error: no controller; exit 1\n' >asleep/sinfo && chmod +x asleep/sinfo
expect_code 2 env PATH="$here/asleep" "$program" slurm small.json
expect_text error.txt "no controller" "no cluster answers; call this where jobs of Slurm are submitted"
expect_code 2 "$program" compare out/small --with missing.json
expect_text error.txt "missing.json: cannot open"

for format in csv xyz vtp contacts contacts-vtp; do
  expect_code 0 "$program" export out/small --format $format
  expect_text error.txt " grains, " " kB"
done
for ending in csv xyz vtp contacts.csv contacts.vtp; do
  [ "$(ls out/small/export/*-1-[0-9].$ending out/small/export/*-[2-9]-[0-9].$ending | wc -l)" -eq 10 ] ||
    fail "not 10 files *.$ending"
done
[ "$(wc -l <out/small/export/index.csv)" -eq 51 ] || fail "the index does not list 50 files"
job=$(sed -n 2p out/small/packings.csv | cut -d, -f1)
grains=$(sed -n 2p out/small/packings.csv | cut -d, -f6)
expect_code 0 "$program" export out/small --format xyz --job "$job" --to one
file=$(sed -n "2s/,$job,.*//p" one/index.csv)
[ "$(ls one)" = "$(printf '%s\n' index.csv "$file")" ] || fail "--job wrote $(ls one)"
[ "$(head -n 1 "one/$file")" -eq "$grains" ] || fail "wrong number of grains"
expect_code 0 "$program" export out/small --job "$job,$(sed -n 3p out/small/packings.csv | cut -c1-12)" --to two
[ "$(ls two/*.csv | wc -l)" -eq 3 ] || fail "--job A,B wrote $(ls two)"
expect_code 2 "$program" export out/small --job nosuchjob
expect_text error.txt "nosuchjob"

# A bed that cannot be read is told, and ends nothing but its own file.
cp -r out/small damaged
rm -r damaged/export
damage_bed damaged "$(packing_lines damaged | grep "$job")" 50
expect_code 4 "$program" export damaged --format xyz
expect_text error.txt "warning: damaged/shards/1-of-1.beds: packing $job: damaged"
expect_text out.txt "9 packings written to damaged/export"
[ "$(wc -l <damaged/export/index.csv)" -eq 10 ] || fail "the index does not list 9 files"
[ "$(ls damaged/export/*.xyz | wc -l)" -eq 9 ] || fail "a damaged bed kept others from their files"
expect_code 4 "$program" export damaged --format xyz --job "$job" --to none
expect_text error.txt "packing $job: damaged"
[ -z "$(ls none)" ] || fail "a damaged bed was written: $(ls none)"

# All packings are there, and the end of the run that the report tells of is damaged: not in silence.
rm -rf damaged && cp -r out/small damaged
sed -i '$ s/"ended"/"ender"/' damaged/shards/1-of-1.jsonl
expect_code 0 "$program" report damaged
expect_text out.txt "the last run has not ended"
expect_text error.txt "warning: damaged/shards/1-of-1.jsonl:12: torn or damaged line"

# Where no packing can be read, as after a change of version, what was written before stays.
rm -rf damaged && cp -r out/small damaged
sed -i 's/"solid_fraction":/"solid_friction":/' damaged/shards/1-of-1.jsonl
expect_code 4 "$program" report damaged
expect_text error.txt "damaged: nothing stored there can be read, since it is damaged or of another"
cmp damaged/packings.csv out/small/packings.csv || fail "tables that could not be made again are gone"

# So it stays where all beds are gone, or the whole folder of what is stored.
rm -rf damaged && cp -r out/small damaged
rm damaged/shards/1-of-1.beds
for command in report status compare; do
  [ $command != compare ] || cp out/small/shards/1-of-1.beds damaged/shards # and then one damaged bed
  [ $command != compare ] || damage_bed damaged "$(packing_lines damaged | grep "$job")" 50
  with=() && [ $command != compare ] || with=(--with "$configs/paper-spheres.reference.json")
  expect_code 4 "$program" $command damaged "${with[@]}"
  [ "$(grep -c '^warning: damaged/shards/1-of-1.beds: ' error.txt)" -eq 1 ] || fail "not one warning"
done
cmp damaged/packings.csv out/small/packings.csv || fail "report wrote empty tables over good ones"
expect_code 0 "$program" status damaged
expect_code 4 "$program" status --check damaged
expect_code 4 "$program" report damaged
[ "$(grep -c ',pending,' damaged/packings.csv)" -eq 1 ] || fail "a damaged bed is in the table"
rm -r damaged/shards && cp out/small/packings.csv damaged
expect_code 4 "$program" report damaged
expect_text error.txt "damaged/shards, is missing or empty; tables and page are left as they were"
cmp damaged/packings.csv out/small/packings.csv || fail "report wrote empty tables over good ones"
rm -rf damaged && cp -r out/small damaged
rm damaged/shards/1-of-1.beds
"$program" run small.json --no-report --out damaged >out.txt 2>error.txt || [ $? -eq 1 ]
expect_text error.txt "warning: damaged/shards/1-of-1.beds: 10 packings, " " and others: missing; made anew now"

# Packings that have other names now, as their groups have other numbers, are not there twice.
cp -r out/small wider
sed 's/\[3, 4/[2.5, 3, 4/' small.json >wider.json
"$program" run wider.json --out wider --no-report --quiet || [ $? -eq 1 ]
expect_code 0 "$program" export wider --format xyz
expect_text error.txt "note: " "of an earlier export removed, as the same packings have other names now"
[ "$(ls wider/export/*.xyz | wc -l)" -eq 12 ] || fail "files of an earlier export are left"
[ "$(grep -c '\.xyz,' wider/export/index.csv)" -eq 12 ] || fail "the index does not list 12 files"
ls wider/export/*.vtp >/dev/null || fail "files of another format are gone"
cmp <(values_of out/small) <("$program" run small.json --out wider --no-report --quiet >&2 || :; values_of wider) ||
  fail "another form of the sweep in the folder changes values"
expect_code 0 "$program" status wider
expect_text out.txt "2 stored packings belong to another form of the sweep; " "collect wider --out OTHER --current"
expect_code 0 env PATH=none "$program" collect wider --out only --current
expect_text error.txt "note: wider: 2 packings of another form of its sweep left out"
[ "$(packing_lines only | wc -l)" -eq 10 ] || fail "--current collected others"

# Units that are added later change no packing, and all that is printed.
sed 's/"seed": 3/"units": { "d": 3.2, "unit": "mm", "density": 2500 }, "seed": 3/' small.json >mm.json
expect_code 0 "$program" validate mm.json
expect_text out.txt "right: 10 packings, 5 parameter sets, d = 3.2 mm, grains of 2500 kg/m³, widths of 9.6 to 19.2 mm"
packed=$(packing_lines out/small)
"$program" run mm.json --out out/small >out.txt 2>error.txt || [ $? -eq 1 ]
[ "$packed" = "$(packing_lines out/small)" ] || fail "units made packings anew"
expect_text out.txt "W/mm" "kg/m³ ± error"
expect_text out/small/groups.csv "width_mm" "bulk_density_error" "overlap_mean_mm"
expect_text out/small/fits.csv "zeta_error_mm"
expect_text out/small/columns.csv "decays.csv,lambda_mm,mm,"
expect_text out/small/report.html "bulk density / kg/m³" "d = 3.2 mm" "W / mm"
cp out.txt report.txt
expect_code 0 env PATH="$here/no-programs" "$program" report out/small
cmp out.txt report.txt || fail "report prints other units than run"
expect_code 0 "$program" export out/small --format obj --in-units --job "$job" --to in_mm
expect_text out.txt "Lengths in them are in mm"
grep -q "lengths in mm" in_mm/*.obj || fail "surfaces are not in mm"
expect_code 2 "$program" export out/small --format contacts --in-units
expect_text error.txt "--in-units is of --format csv, xyz, vtp, stl, obj and voxels, not of contacts"
expect_code 0 "$program" export out/small --in-units --job "$job" --to in_mm
expect_text error.txt "1/1  " ".csv  "
expect_code 0 "$program" export out/small --job "$job" --to in_mm --quiet
[ ! -s error.txt ] || fail "export --quiet printed $(cat error.txt)"
expect_code 0 "$program" export out/small --job "$job" --to one
expect_text out.txt "Lengths in them are in d, which is 3.2 mm"

# A file where the output folder should be, and a folder that cannot be written.
touch taken
expect_code 4 "$program" run small.json --out taken
expect_text error.txt "taken"
expect_code 4 "$program" run small.json --out /proc/grainsweep
expect_text error.txt "/proc/grainsweep"

# Quiet: nothing but warnings.
code=0
"$program" run small.json --quiet >quiet.txt 2>&1 || code=$?
[ "$code" -le 1 ] && [ ! -s quiet.txt ] || fail "--quiet printed $(cat quiet.txt)"

# --fresh asks, and without a terminal wants --yes.
before=$(packing_lines out/small)
expect_code 2 "$program" run small.json --fresh
expect_text error.txt "--yes"
[ "$before" = "$(packing_lines out/small)" ] || fail "--fresh deleted without asking"

command -v python3 >/dev/null || skip "python3 is not installed: plan --json was not read"
python3 -m json.tool plan.json >/dev/null || fail "plan --json is no JSON"
# A sweep to start from is right, has its schema beside it, and replaces none.
mkdir anew
cd anew
expect_code 0 "$program" init walls
expect_code 0 "$program" validate walls.json
expect_text out.txt "walls.json: right: 24 packings, 8 parameter sets"
[ ! -s error.txt ] || fail "the sweep of init has something unused: $(cat error.txt)"
"$program" schema | cmp - sweep.schema.json || fail "init wrote another schema"
expect_code 2 "$program" init walls
expect_text error.txt "walls.json is there already"
expect_code 2 "$program" init walls.json
expect_text error.txt "walls.json is there already"
expect_code 0 "$program" init gaps.json
expect_code 0 "$program" validate gaps.json
grep -q '"name": "gaps"' gaps.json || fail "init took the name of its file for that of the sweep"
[ ! -e gaps.json.json ] || fail "init ended the name of its file twice"
expect_code 2 "$program" init ../walls
expect_code 2 "$program" init .json
cd ..
echo "the commands work"
