# Stopped, torn, killed: finished packings are kept, nothing is made twice, the tables come out the
# same.
source "$(dirname "$0")/common.sh" "$1"
write_sweep sweep.json 6 8

run_to_the_end() { # FOLDER
  local code=0
  "$program" run sweep.json --threads 2 --out "$1" >report.txt 2>progress.txt || code=$?
  [ "$code" -le 1 ] || fail "run ended with $code: $(cat progress.txt)"
}

lines_in() { # FOLDER
  packing_lines "$1" | wc -l
}

run_to_the_end whole
values_of whole >whole.txt

# stop_with SIGNAL CODE FOLDER: stopped in the middle it ends within 2 s with this code.
stop_with() {
  start "$program" run sweep.json --threads 2 --out "$3"
  wait_until has_packings "$3" 4 || fail "$3: ended too soon: $(cat said.txt)"
  end_in_time "$1"
  [ "$code" -eq "$2" ] || fail "$1 ended with $code: $(cat said.txt)"
  expect_text said.txt "are kept in $3" "grainsweep run sweep.json --out $3 --threads 2"
  [ "$(grep -c pending "$3/packings.csv")" -ge 1 ] || fail "nothing was left to do after $1"
  expect_text "$3/report.html" "no figures, since the run had to end; grainsweep report $3 draws" ">pending<"
  [ ! -e "$3/figures" ] || fail "figures were drawn after $1"
}

for end in INT:130 TERM:143 HUP:129; do
  signal=${end%:*} expected=${end#*:}
  stop_with $signal $expected stopped-$signal
  expect_code 0 "$program" status stopped-$signal
  expect_text out.txt "Go on with: " "grainsweep run sweep.json"
  kept=$(lines_in stopped-$signal)
  run_to_the_end stopped-$signal
  expect_text progress.txt "$kept of 30 packings are done, going on" "30/30  "
  [ "$(grep -c '^[0-9]*/30  ' progress.txt)" -eq $((30 - kept)) ] || fail "a packing was made twice"
  [ "$(lines_in stopped-$signal)" -eq 30 ] || fail "not every packing has one line"
  values_of stopped-$signal | cmp - whole.txt || fail "other values after $signal"
  ! grep -q "since the run had to end" stopped-$signal/report.html || fail "the page was not made anew"
done

# Killed outright, with a line torn, a bed lost and the curves of another damaged on top.
start "$program" run sweep.json --threads 2 --out killed
wait_until has_packings killed 4 || fail "ended too soon: $(cat said.txt)"
end_runner KILL
journal=killed/shards/1-of-1.jsonl
truncate -s -9 "$journal"
mapfile -t lines < <(packing_lines killed)
jobs=()
for number in 0 1; do
  jobs+=("$(sed 's/.*"job":"\([0-9a-f]*\)".*/\1/' <<<"${lines[number]}")")
  damage_bed killed "${lines[number]}" $((50 + 150 * number))
done
run_to_the_end killed
expect_text progress.txt "warning: killed/shards/1-of-1.jsonl:" "torn or damaged line" \
  "warning: killed/shards/1-of-1.beds: packings " ": damaged, or"
grep -qE "beds: packings (${jobs[0]}, ${jobs[1]}|${jobs[1]}, ${jobs[0]}): damaged" progress.txt ||
  fail "not both damaged beds are named: $(cat progress.txt)"
for table in profiles decays distributions sizes; do
  cmp killed/$table.csv whole/$table.csv || fail "other $table after SIGKILL"
done
cmp <(beds_in killed) <(beds_in whole) || fail "other grains after SIGKILL"
values_of killed | cmp - whole.txt || fail "other values after SIGKILL"

# All there: a run makes nothing, and the tables stay as they are.
cp whole/packings.csv before.csv
run_to_the_end whole
[ ! -s progress.txt ] || fail "a finished sweep was made again: $(cat progress.txt)"
cmp before.csv whole/packings.csv || fail "tables changed without a new packing"

# A page that a run leaves as it was is told.
"$program" run sweep.json --threads 2 --out whole --no-report >out.txt 2>error.txt || [ $? -eq 1 ]
[ ! -s error.txt ] || fail "the page of the same packings was called old: $(cat error.txt)"
damage_bed whole "$(packing_lines whole | head -n 1)" 50
"$program" run sweep.json --threads 2 --out whole --no-report >out.txt 2>error.txt || [ $? -eq 1 ]
expect_text error.txt "note: whole/report.html is of an earlier run; "

# One runner at a time: held up, so that it is still there.
start "$program" run sweep.json --threads 2 --out busy
wait_until has_packings busy 1 || fail "ended too soon: $(cat said.txt)"
kill -STOP "$runner"
expect_code 3 "$program" run sweep.json --threads 2 --out busy
expect_text error.txt "another runner" "process $runner"
expect_code 0 "$program" status busy
expect_text out.txt "Running: host "
expect_code 0 "$program" status busy --json
expect_text out.txt '"runners": [' '"host ' "process $runner (1-of-1)\""
kill -CONT "$runner"
end_runner TERM

# Shards of two forms of a sweep would make half of each: the second one is refused.
start "$program" run sweep.json --threads 1 --out forms --shard 1/2 --no-report
wait_until has_packings forms 1 || fail "ended too soon: $(cat said.txt)"
kill -STOP "$runner"
sed 's/"replicates": *[0-9]*/"replicates": 2/' sweep.json >other.json
expect_code 3 "$program" run other.json --threads 1 --out forms --shard 2/2
expect_text error.txt "forms: another runner makes another form of this sweep here (host " "process $runner"
kill -CONT "$runner"
end_runner TERM
code=0
"$program" run other.json --threads 1 --out forms --shard 2/2 --quiet || code=$?
[ "$code" -le 1 ] || fail "a shard of the new form ended with $code"

# --fresh --yes starts anew.
expect_code 0 "$program" status busy
code=0
"$program" run sweep.json --threads 2 --out busy --fresh --yes >/dev/null 2>progress.txt || code=$?
[ "$code" -le 1 ] || fail "--fresh ended with $code"
[ "$(wc -l <progress.txt)" -eq 30 ] || fail "--fresh did not make everything anew"
echo "stopped runs go on where they were"
