# Two and eight runners on one folder: one works, the others leave with code 3 and name it; one that
# is killed needs no unlocking.
source "$(dirname "$0")/common.sh" "$1"
cat >sweep.json <<'JSON'
{ "name": "runners", "seed": 5, "replicates": 14,
  "base": { "box": { "length": 5, "width": 5 }, "fill": { "solid_height": 8 }, "accuracy": "balanced" } }
JSON
make_reference sweep.json

busy=0
# start_all COUNT: starts COUNT at once; counts those that were refused.
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

# A runner waits a fifth of a second for the lock; one that waited until the work was done met
# nobody.
rounds=$(times 6 100)
for count in 2 8; do
  goal=$((busy + rounds * count / 2))
  for ((round = 1; round <= rounds || busy < goal; ++round)); do
    [ "$round" -le $((10 * rounds)) ] || fail "only $busy runners met another one"
    start_all "$count"
    same_as_reference out "$count runners, round $round"
    rm -r out
  done
done

for round in $(seq "$rounds"); do
  start "$program" run sweep.json --threads 1 --out out
  wait_until has_packings out "$(between 0 $((packings - 1)))" || true
  end_runner KILL
  run_to_the_end sweep.json out --threads 2
  same_as_reference out "after a runner that was killed, round $round"
  rm -r out
done
echo "$((2 * rounds)) times two or eight runners on one folder: one worked, $busy left; $rounds killed ones"
