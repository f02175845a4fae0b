# Two and eight runners on one folder: one works, the others leave with code 3 and name it; one that
# is killed needs no unlocking.
source "$(dirname "$0")/common.sh" "$1"
# A runner waits a fifth of a second for the lock, so that the work has to take longer.
cat >sweep.json <<'JSON'
{ "name": "runners", "seed": 5, "replicates": 14,
  "base": { "box": { "length": 5, "width": 5 }, "fill": { "solid_height": 8 }, "accuracy": "balanced" } }
JSON
make_reference sweep.json

busy=0
# start_all COUNT: so many at once; counts those that were refused.
start_all() {
  local count=$1 number code worked=0 pids=()
  for number in $(seq "$count"); do
    "$program" run sweep.json --threads 2 --out out >said.$number 2>&1 &
    pids+=($!)
  done
  for number in $(seq "$count"); do
    code=0
    wait "${pids[number - 1]}" || code=$?
    case $code in
      0 | 1) ! grep -q '^[0-9]*/[0-9]*  ' said.$number || worked=$((worked + 1)) ;;
      3)
        busy=$((busy + 1))
        grep -q "^grainsweep: out: another runner works here (host .*, process [0-9]*)" said.$number ||
          fail "the runner at work is not named: $(cat said.$number)"
        [[ " ${pids[*]} " == *" $(sed 's/.*process \([0-9]*\)).*/\1/' said.$number) "* ]] ||
          fail "another process is named: $(cat said.$number)"
        ;;
      *) fail "runner $number of $count ended with $code: $(cat said.$number)" ;;
    esac
  done
  [ "$worked" -eq 1 ] || fail "$worked of $count runners worked"
}

rounds=$(times 10 100)
for count in 2 8; do
  for round in $(seq "$rounds"); do
    start_all "$count"
    same_as_reference out "$count runners, round $round"
    rm -r out
  done
done
[ "$busy" -gt $((4 * rounds)) ] || fail "only $busy of $((8 * rounds)) runners met another one"

for round in $(seq "$rounds"); do
  "$program" run sweep.json --threads 1 --out out >said.txt 2>&1 &
  pause "$(between 0 "$duration")"
  kill -KILL $! 2>/dev/null || true
  wait $! 2>/dev/null || true
  run_to_the_end sweep.json out --threads 2
  same_as_reference out "after a runner that was killed, round $round"
  rm -r out
done
echo "$((2 * rounds)) times two or eight runners on one folder: one worked, $busy left; $rounds killed ones"
