# A sweep whose groups grow until their errors are as asked for has the same tables for any number of
# threads and shards, and after a kill.
source "$(dirname "$0")/common.sh" "$1"

cat >sweep.json <<'JSON'
{ "name": "growing", "seed": 5, "replicates": { "until": { "solid_fraction": 0.009 }, "most": 30 },
  "base": { "box": { "length": 5 }, "fill": { "grains": 90 }, "accuracy": "fast",
            "measure": { "exclude_floor": 1, "exclude_surface": 1 } },
  "sweep": [ { "label": "grows", "grid": { "box.width": [3, 4] } },
             { "label": "does not", "replicates": 2, "set": { "box.width": 5 } } ] }
JSON
expect_code 0 "$program" validate sweep.json
expect_text out.txt 'at least 14 packings'
expect_code 0 "$program" plan sweep.json
expect_text out.txt 'at most 62 packings'

# What no number of packings can meet is told where it is written.
sed 's/0.009/0.001/; s/"replicates": 2/"replicates": { "until": { "fit": { "C": 0.1 } } }/' \
  sweep.json >wishes.json
expect_code 2 "$program" validate wishes.json
expect_text error.txt 'wishes.json:1:78 /replicates/until/solid_fraction: cannot be met in "grows"' \
  'wishes.json:5:71 /sweep/1/replicates/until/fit: cannot be had of "does not"' '2 errors'

# same FOLDER [ONE]: it has the tables of one run on one thread.
same() {
  local table one=${2:-one}
  cmp <(values_of "$one") <(values_of "$1") || fail "$1: other values"
  for table in "$one"/*.csv; do
    table=${table#"$one"/}
    [ "$table" = packings.csv ] || cmp "$one/$table" "$1/$table" || fail "$1: other $table"
  done
}
expect_code 0 "$program" run sweep.json --out one --threads 1 --no-report
expect_text out.txt "Errors as asked for (95 %) in 2 of 2 groups"
packings=$(($(wc -l <one/packings.csv) - 1))
((packings > 14 && packings < 62)) || fail "$packings packings: some groups grow, none to the most"
expect_code 0 "$program" run sweep.json --out two --threads 2 --no-report --quiet
same two

for shard in 3 1 2; do
  "$program" run sweep.json --out shards --shard $shard/3 --no-report >said.txt 2>&1
done
same shards

start "$program" run sweep.json --out killed --threads 1 --no-report
wait_until has_packings killed 8 || fail "there was nothing to kill: $(cat said.txt)"
end_runner KILL
expect_code 0 "$program" run sweep.json --out killed --threads 1 --no-report --quiet
same killed

# Each seed of a point grows by itself, whichever key of the grid comes first.
sed 's/"box.width": \[3, 4\]/"box.width": [3, 4], "seed": [1, 2]/' sweep.json >seeds.json
expect_code 0 "$program" plan seeds.json
expect_text out.txt 'Next: 26 packings: 12 of grows, W = 3; 12 of grows, W = 4; 2 of does not, W = 5' 'at most 122 packings'

# On a cluster a growing group remains whole, and has time to grow.
mkdir bin
echo "echo 'main*|1-00:00:00|2|64000|12'" >bin/sinfo
echo "echo 'MaxArraySize = 1001'" >bin/scontrol
chmod +x bin/sinfo bin/scontrol
sed 's/"most": 30/"most": 10000/; s/"grains": 90/"grains": 400000/; s/"length": 5/"length": 400/' \
  sweep.json >long.json
PATH=$here/bin:$PATH expect_code 0 "$program" slurm long.json --out long --print --shards 9
expect_text error.txt 'growing: 14 packings at first' '4 shards' 'growing groups and families whole' \
  'at most 20002 packings'
expect_text out.txt '#SBATCH --array=1-4'
if grep -q 'no cluster is needed' error.txt; then fail "what may grow for hours needs no cluster"; fi
expect_code 0 "$program" plan long.json --shards 9
expect_text out.txt '5 have nothing to make, since growing groups and families remain whole'

# What no number of packings can meet.
sed 's/0.009/0.001/' sweep.json >vain.json
expect_code 2 "$program" run vain.json --out vain
expect_text error.txt 'settled as "fast" such packings may be off by 0.003'

# A fit whose packings go where they gain most: the same wherever and however often it is run.
sed 's/"solid_fraction": 0.009/"fit": { "phi_bulk": 0.012 }/; s/\[3, 4\]/[1.8, 2.5, 3, 4]/' sweep.json >fit.json
expect_code 0 "$program" plan fit.json
expect_text out.txt 'Next: 26 packings: 6 of grows, W = 1.8; 6 of grows, W = 2.5; 6 of grows, W = 3; 6 of '
expect_code 0 "$program" run fit.json --out fit-one --threads 1 --no-report
# At such narrow gaps the solid fraction is no straight line.
expect_text out.txt "Errors as asked for (95 %) in 0 of 1 fit" "in 1 the packings scatter as little"
packings=$(($(wc -l <fit-one/packings.csv) - 1))
((packings > 26 && packings < 122)) || fail "$packings packings: the fit grows, not to the most"
expect_code 0 "$program" plan fit.json --out fit-one
expect_text out.txt 'Nothing comes next. Errors as asked for (95 %) in 0 of 1 fit'
expect_code 0 "$program" run fit.json --out fit-two --threads 2 --no-report --quiet
same fit-two fit-one
for shard in 2 3 1; do
  "$program" run fit.json --out fit-shards --shard $shard/3 --no-report >said.txt 2>&1
done
same fit-shards fit-one
start "$program" run fit.json --out fit-killed --threads 1 --no-report
wait_until has_packings fit-killed 30 || fail "there was nothing to kill: $(cat said.txt)"
end_runner KILL
expect_code 0 "$program" plan fit.json --out fit-killed
expect_text out.txt 'Next: '
expect_code 0 "$program" run fit.json --out fit-killed --threads 1 --no-report --quiet
same fit-killed fit-one
sed 's/\[1.8, 2.5, 3, 4\]/[3]/' fit.json >narrow.json
expect_code 2 "$program" validate narrow.json
expect_text error.txt 'takes 3 or more widths'
