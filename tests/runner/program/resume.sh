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
  cat "$1"/journal-*.jsonl 2>/dev/null | wc -l
}

wait_for_lines() { # FOLDER COUNT
  for _ in $(seq 600); do
    [ "$(lines_in "$1")" -ge "$2" ] && return
    sleep 0.05
  done
  fail "no $2 packings in $1 after 30 s"
}

run_to_the_end whole
values_of whole >whole.txt

# stop_with SIGNAL CODE FOLDER: stopped in the middle it ends within 2 s with this code.
stop_with() {
  local code=0 started
  "$program" run sweep.json --threads 2 --out "$3" >out.txt 2>error.txt &
  wait_for_lines "$3" 4
  started=$(date +%s%N)
  kill -"$1" $!
  wait $! || code=$?
  local took=$((($(date +%s%N) - started) / 1000000))
  [ "$code" -eq "$2" ] || fail "$1 ended with $code: $(cat error.txt)"
  [ "$took" -lt 2000 ] || fail "$1 took $took ms"
  expect_text error.txt "are kept in $3" "grainsweep run sweep.json --out $3"
  [ "$(grep -c pending "$3/packings.csv")" -ge 1 ] || fail "nothing was left to do after $1"
}

for signal in INT TERM; do
  # A background job of a script ignores SIGINT unless it is told not to; `set -m` does that.
  set -m
  [ $signal = INT ] && expected=130 || expected=143
  stop_with $signal $expected stopped-$signal
  set +m
  expect_code 0 "$program" status stopped-$signal
  expect_text out.txt "Go on with: grainsweep run sweep.json"
  kept=$(lines_in stopped-$signal)
  run_to_the_end stopped-$signal
  [ "$(wc -l <progress.txt)" -eq $((30 - kept)) ] || fail "a packing was made twice"
  [ "$(lines_in stopped-$signal)" -eq 30 ] || fail "not every packing has one line"
  values_of stopped-$signal | cmp - whole.txt || fail "other values after $signal"
done

# Killed outright, with a line torn, a bed lost and the curves of another damaged on top.
"$program" run sweep.json --threads 2 --out killed >/dev/null 2>&1 &
wait_for_lines killed 4
kill -KILL $!
wait $! 2>/dev/null || true
journal=$(ls killed/journal-*.jsonl)
truncate -s -9 "$journal"
lost=$(sed -n 1p "$journal" | sed 's/.*"job":"\([0-9a-f]*\)".*/\1/').grains
damaged=$(sed -n 2p "$journal" | sed 's/.*"job":"\([0-9a-f]*\)".*/\1/').grains
rm "killed/states/$lost"
printf '\xff' | dd of="killed/states/$damaged" bs=1 seek=200 conv=notrunc status=none
run_to_the_end killed
expect_text progress.txt "warning: killed/journal-" "torn or damaged line" \
  "warning: killed/states/$lost: missing" "warning: killed/states/$damaged: missing, damaged or"
for table in profiles decays distributions; do
  cmp killed/$table.csv whole/$table.csv || fail "other $table after SIGKILL"
done
diff -rq killed/states whole/states || fail "other grains after SIGKILL"
values_of killed | cmp - whole.txt || fail "other values after SIGKILL"

# All there: a run makes nothing, and the tables stay as they are.
cp whole/packings.csv before.csv
run_to_the_end whole
[ ! -s progress.txt ] || fail "a finished sweep was made again: $(cat progress.txt)"
cmp before.csv whole/packings.csv || fail "tables changed without a new packing"

# One runner at a time.
"$program" run sweep.json --threads 2 --out busy >/dev/null 2>&1 &
wait_for_lines busy 1
expect_code 3 "$program" run sweep.json --threads 2 --out busy
expect_text error.txt "another runner" "process $!"
expect_code 0 "$program" status busy
expect_text out.txt "Running: host "
expect_code 0 "$program" status busy --json
expect_text out.txt '"runner": "host ' "process $!\""
kill -TERM $!
wait $! || true

# --fresh --yes starts anew.
expect_code 0 "$program" status busy
code=0
"$program" run sweep.json --threads 2 --out busy --fresh --yes >/dev/null 2>progress.txt || code=$?
[ "$code" -le 1 ] || fail "--fresh ended with $code"
[ "$(wc -l <progress.txt)" -eq 30 ] || fail "--fresh did not make everything anew"
echo "stopped runs go on where they were"
