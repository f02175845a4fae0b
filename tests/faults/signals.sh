# SIGTERM, SIGINT, SIGHUP and SIGUSR1 at any moment: exit code 143, 130, 129 or 138 within 2 s, the
# same bytes afterwards.
source "$(dirname "$0")/common.sh" "$1"
# Six beds of 10 to 20 ms beside one of a quarter of a second, which begins first: however late a
# signal comes after any of the six, the runner is at work.
write_small_sweep sweep.json \
  '{ "label": "long", "replicates": 1, "set": { "box": { "length": 7, "width": 7 },
     "fill.solid_height": 10, "accuracy": "balanced" } }'
make_reference sweep.json

# stop_with SIGNAL CODE: the runner ends with CODE within 2 s; false if it had ended before.
stop_with() {
  end_in_time "$1"
  [ "$code" -gt 1 ] || return 1
  [ "$code" -eq "$2" ] || fail "$1 ended with $code: $(cat said.txt)"
  stopped=$((stopped + 1))
}

# The wanted number of each, without those that came after the end.
stopped=0
wanted=$(times 10 200)
tries=0
for signal in "TERM 143" "INT 130" "HUP 129" "USR1 138"; do
  goal=$((stopped + wanted))
  while [ "$stopped" -lt "$goal" ]; do
    tries=$((tries + 1))
    [ "$tries" -le $((20 * wanted)) ] || fail "only $stopped of $tries signals came before the end"
    start "$program" run sweep.json --no-report --threads 2 --out out
    wait_until has_packings out "$(between 0 $((packings - 1)))" || true
    pause "$(between 0 10)"
    stop_with $signal || true
    run_to_the_end sweep.json out --threads 2
    same_as_reference out "after $signal, try $tries"
    rm -r out
  done
done

# One bed of a second or two: stopped inside it again and again, it goes on from where it was.
cat >long.json <<'JSON'
{ "name": "long", "base": { "box": { "length": 14, "width": 14 }, "accuracy": "balanced" } }
JSON
rm -r reference
make_reference long.json

# has_worked MILLISECONDS: the runner has had so much CPU time, however busy the machine is, besides
# what it starts up in, 25 ms on a quick machine.
has_worked() {
  local time start_up=60
  time_of run "$runner"
  [ "$time" -ge $((($1 + start_up) * 1000000)) ]
}

# Sooner if it came to its end, since CPU time differs from run to run.
cpu=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "cpu_seconds") column = i; next }
  { printf "%d", 1000 * $column }' reference/packings.csv)
for share in 5 8 12 20; do
  rm -rf out
  inside=0
  for part in 1 2 3; do
    start "$program" run long.json --no-report --threads 2 --out out
    wait_until has_worked $((cpu / share)) || break
    stop_with TERM 143 && inside=$((inside + 1)) || break
  done
  [ "$inside" -lt 3 ] || break
done
[ "$inside" -eq 3 ] || fail "the bed of $cpu ms was never stopped three times before its end"
has_checkpoint out || fail "no checkpoint after SIGTERM"

# A second SIGTERM, as from a launcher beside the batch system, does not end it before all is saved.
rm -r out
start "$program" run long.json --no-report --threads 2 --out out
wait_until has_worked $((cpu / 8)) || fail "ended too soon: $(cat said.txt)"
kill -TERM "$runner"
stop_with TERM 143 || fail "ended before the second SIGTERM"
has_checkpoint out || fail "no checkpoint after two SIGTERMs"
run_to_the_end long.json out --threads 2
grep -q 'went on from step [1-9]' said.txt || fail "did not go on from a checkpoint: $(cat said.txt)"
same_as_reference out "after stopping inside a bed"
echo "$tries signals and three inside a bed, $stopped of them before the end: in time, the same bytes"
