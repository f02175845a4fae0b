# SIGTERM and SIGINT at random times: exit code 143 or 130 within 2 s, the same bytes afterwards.
source "$(dirname "$0")/common.sh" "$1"
write_small_sweep sweep.json
make_reference sweep.json

# stop_with SIGNAL CODE FILE FOLDER MILLISECONDS: ends so within 2 s, unless it had ended before.
stop_with() {
  local code=0 began took
  set -m # else a background job of a script ignores SIGINT
  "$program" run "$3" --threads 2 --out "$4" >said.txt 2>&1 &
  set +m
  pause "$5"
  began=$(milliseconds)
  kill -"$1" $! 2>/dev/null || true
  wait $! || code=$?
  took=$(($(milliseconds) - began))
  [ "$took" -lt 2000 ] || fail "$1 took $took ms"
  [ "$code" -gt 1 ] || return 0
  [ "$code" -eq "$2" ] || fail "$1 ended with $code: $(cat said.txt)"
  stopped=$((stopped + 1))
}

# As many of each as are wanted, those not counted that came after the end.
stopped=0
wanted=$(times 10 200)
tries=0
for signal in "TERM 143" "INT 130"; do
  goal=$((stopped + wanted))
  while [ "$stopped" -lt "$goal" ]; do
    tries=$((tries + 1))
    [ "$tries" -le $((10 * wanted)) ] || fail "only $stopped of $tries signals came before the end"
    stop_with $signal sweep.json out "$(between 0 $((duration * 3 / 4)))"
    run_to_the_end sweep.json out --threads 2
    same_as_reference out "after $signal, try $tries"
    rm -r out
  done
done

# One bed of a second or two: stopped inside it again and again, it goes on from where it was.
cat >long.json <<'JSON'
{ "name": "long", "base": { "box": { "length": 8, "width": 8 }, "accuracy": "balanced" } }
JSON
rm -r reference
make_reference long.json
has_checkpoint() { [ -n "$(find out/checkpoints -type f 2>/dev/null)" ]; }
# Sooner where it came to its end, the reference having been held up.
for share in 4 6 8 12; do
  rm -rf out
  for part in 1 2 3; do stop_with TERM 143 long.json out $((duration / share)); done
  ! has_checkpoint || break
done
has_checkpoint || fail "no checkpoint after SIGTERM"
run_to_the_end long.json out --threads 2
grep -q 'went on from step [1-9]' said.txt || fail "did not go on from a checkpoint: $(cat said.txt)"
same_as_reference out "after stopping inside a bed"
echo "$tries signals and a few inside a bed, $stopped of them before the end: in time, the same bytes"
