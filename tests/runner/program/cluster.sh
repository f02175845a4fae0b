# The recipes in configs/cluster make a sweep with the tables of one run. Engines that are not installed
# are stood in for by what they are to their tasks: their variables. GNU parallel and Snakemake are run
# where they are. Names have spaces, as those of users do.
recipes=$(realpath "$(dirname "$0")/../../../configs/cluster")
source "$(dirname "$0")/common.sh" "$1"
sweep='a sweep.json' out='its tables'
write_sweep "$sweep" 2
mkdir bin
ln -s "$program" bin/grainsweep
PATH=$here/bin:$PATH
unset "${!SLURM_@}" "${!PMI_@}" "${!OMPI_@}"
"$program" run "$sweep" --out one --quiet --no-report || [ $? -eq 1 ]

# made_by RECIPE: the folder of the recipes has the tables of one run.
made_by() {
  local table
  cmp <(values_of one) <(values_of "$out") || fail "$1: other values"
  for table in one/*.csv; do
    table=${table#one/}
    [ "$table" = packings.csv ] || cmp "one/$table" "$out/$table" || fail "$1: other $table"
  done
  rm -r "$out"
}

# element VARIABLE=VALUE...: one of four tasks of a recipe.
element() {
  local recipe=$1
  shift
  env "$@" bash "$recipes/$recipe" "$sweep" "$out" >said.txt 2>&1 || fail "$recipe: $(cat said.txt)"
}
for number in 1 2 3 4; do
  element slurm-array.sh SLURM_ARRAY_TASK_ID=$number SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_COUNT=4 \
    SLURM_JOB_END_TIME=$(($(date +%s) + 3600))
done
expect_text said.txt "Tables in $out"
made_by slurm-array.sh
for number in 1 2 3 4; do
  element grid-engine.sh SGE_TASK_ID=$number SGE_TASK_FIRST=1 SGE_TASK_LAST=4 SGE_TASK_STEPSIZE=1
done
made_by grid-engine.sh
for number in $(seq 16); do
  PBS_O_WORKDIR=$here element pbs.sh PBS_ARRAY_INDEX=$number SWEEP="$sweep" DIR="$out"
done
made_by pbs.sh

# All tasks at once, as the engine starts them: so many as its options or files say.
cat >bin/srun <<'SRUN'
while [[ $1 == -* ]]; do shift; done
for rank in 0 1 2 3; do SLURM_PROCID=$rank SLURM_STEP_NUM_TASKS=4 "$@" & done
wait
SRUN
cat >bin/hq <<'HQ'
while [[ $1 != grainsweep ]]; do shift; done
for number in $(seq 16); do
  HQ_TASK_ID=$number "$@" &
  ((number % 4)) || wait
done
wait
HQ
chmod +x bin/srun bin/hq
for recipe in srun.sh hyperqueue.sh; do
  bash "$recipes/$recipe" "$sweep" "$out" >said.txt 2>&1 || fail "$recipe: $(cat said.txt)"
  made_by $recipe
done

run=()
if command -v parallel >/dev/null; then
  echo ":" >machines
  bash "$recipes/parallel.sh" "$sweep" "$out" machines >said.txt 2>&1 </dev/null ||
    fail "parallel.sh: $(cat said.txt)"
  made_by parallel.sh
  run+=("GNU parallel")
fi
if command -v snakemake >/dev/null; then
  snakemake -s "$recipes/Snakefile" -j 2 --config "sweep=$sweep" "out=$out" >said.txt 2>&1 ||
    fail "Snakefile: $(tail said.txt)"
  made_by Snakefile
  sed 's/"name": "[^"]*"/"name": "second"/' "$sweep" >second.json # in the same place
  snakemake -s "$recipes/Snakefile" -j 2 --config sweep=second.json out=second >said.txt 2>&1 ||
    fail "Snakefile: $(tail said.txt)"
  [ -e second/shards/16-of-16.jsonl ] || fail "a second sweep of a Snakefile has no shards"
  run+=(Snakemake)
fi

# A shard that begins while another one writes the tables goes on, and leaves them to it.
mkdir -p "$out/shards"
exec 9>"$out/shards/tables.lock"
flock 9
for number in 1 2; do
  "$program" run "$sweep" --out "$out" --quiet --no-report --shard $number/2 9>&- || [ $? -eq 1 ] ||
    fail "shard $number/2 is refused while tables are written"
done
[ ! -e "$out/groups.csv" ] || fail "two shards write the tables at once"
exec 9>&-
"$program" run "$sweep" --out "$out" --quiet --no-report --shard 2/2 || [ $? -eq 1 ]
made_by "a shard begun while tables were written"

# A bed that no limit of a second holds is begun and saved, and the command to go on is told.
cat >long.json <<'JSON'
{ "name": "long", "base": { "box": { "length": 15, "width": 15 }, "accuracy": "accurate" } }
JSON
expect_code 6 "$program" run long.json --out late --no-report --time-limit 1 --shard 1/1
expect_text error.txt "Stopped by the limit of time." "1 under way in its checkpoints" \
  "--shard 1/1 --time-limit 1"
# A job that Slurm ends is told when by a variable.
SLURM_JOB_END_TIME=$(($(date +%s) + 2)) expect_code 6 "$program" run long.json --out late
expect_text error.txt "Stopped by the limit of time."
expect_text late/report.html "no figures, since the run had to end; grainsweep report late draws"
expect_code 2 "$program" run long.json --out late --time-limit soon
expect_text error.txt "--time-limit soon: give seconds, minutes:seconds"

# Beds without steps to settle end with 1 unless they are tolerated, in any number or up to a share.
sed 's/"fast" }/{ "preset": "fast", "max_steps": 24 } }/' "$sweep" >short.json
expect_code 1 "$program" run short.json --out short --no-report
expect_code 1 "$program" run short.json --out short --no-report --quiet
expect_text error.txt "packings failed or did not settle: see the columns status and reason"
expect_code 0 "$program" run short.json --out short --no-report --quiet --tolerate-unsettled
[ ! -s error.txt ] || fail "what is tolerated is told of: $(cat error.txt)"
expect_code 1 "$program" run short.json --out short --no-report --tolerate-unsettled=0.5
expect_code 2 "$program" run short.json --out short --no-report --tolerate-unsettled=2
echo "recipes of five engines, and ${run[*]:-neither GNU parallel nor Snakemake, which are not installed}"
