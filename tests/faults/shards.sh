# A sweep made by 1, 2, 7 and 64 runners in one folder: the tables and beds of one run, also after
# random kills, where two runners are given the same shard, and where they help each other.
source "$(dirname "$0")/common.sh" "$1"
cat >sweep.json <<'JSON'
{ "name": "mixed", "seed": 5, "replicates": 30,
  "base": { "box": { "length": 3, "width": 3 }, "fill": { "solid_height": 3 },
            "measure": { "exclude_floor": 0, "exclude_surface": 1 }, "accuracy": "fast" },
  "sweep": [ { "label": "walls", "grid": { "box.width": [3, 3.5, 4, 4.5, 5, 5.5, 6] } },
             { "label": "large", "set": { "box.width": 4, "fill.solid_height": 6 } },
             { "label": "two", "set": { "sizes": { "small_share": 0.5, "size_ratio": 0.8 } } },
             { "label": "bulk", "set": { "box.width": 4, "box.y": "periodic" } } ] }
JSON
make_reference sweep.json

# shard NUMBER COUNT OPTION...: makes that shard as one of few runners would on a machine of its
# own.
shard() {
  local number=$1 count=$2 code=0
  shift 2
  "$program" run sweep.json --no-report --quiet --threads 1 --out out --shard "$number/$count" "$@" \
    >"said.$number" 2>&1 </dev/null || code=$?
  [ "$code" -le 1 ] || fail "shard $number/$count ended with $code: $(cat "said.$number")"
}

# all_shards COUNT: four at a time.
all_shards() {
  local number process processes=()
  for number in $(seq "$1"); do
    shard "$number" "$1" &
    processes+=($!)
    if [ $((number % 4)) -ne 0 ] && [ "$number" -lt "$1" ]; then continue; fi
    for process in "${processes[@]}"; do
      wait "$process" || fail "not every shard of $1 ended well"
    done
    processes=()
  done
}

for count in 1 2 7 64; do
  all_shards $count
  same_as_reference out "$count shards"
  files=(out/shards/*)
  [ ${#files[@]} -le $((2 * count + 1)) ] || fail "$count shards left ${#files[@]} files"
  expect_code 0 "$program" status out
  expect_text out.txt "$packings of $packings packings done" "No runner at work"
  [ ! -e out/shards/claims ] || fail "$count shards left claims"
  rm -r out
done

# A runner that has finished takes over what another one, held in its first packing, has not begun.
# When that one goes on, it leaves out what was taken, and finds the sweep made.
start "$program" run sweep.json --no-report --threads 1 --out out --shard 1/2
wait_until has_packings out 1 || fail "ended too soon: $(cat said.txt)"
kill -STOP "$runner"
shard 2 2 --alone
alone=$(packing_lines out | wc -l)
[ "$alone" -lt $((packings - 1)) ] || fail "nothing was left to take over: $alone of $packings are made"
shard 2 2
helped=$(packing_lines out | wc -l)
[ "$helped" -eq $((packings - 1)) ] || fail "$helped packings after help, $alone before, of $packings"
kill -CONT "$runner"
wait "$runner" && code=0 || code=$?
[ "$code" -le 1 ] || fail "after help the runner ended with $code: $(cat said.txt)"
same_as_reference out "a runner that helped"
[ ! -e out/shards/claims ] || fail "claims are left"
rm -r out

# Each shard given to two runners at once: one works, or both in turn.
busy=0
for number in $(seq 7); do
  pids=()
  for twin in 1 2; do
    "$program" run sweep.json --no-report --threads 1 --out out --shard "$number/7" >"said.$twin" 2>&1 &
    pids+=($!)
  done
  for twin in 1 2; do
    code=0
    wait "${pids[twin - 1]}" || code=$?
    case $code in
      0 | 1) ;;
      3) busy=$((busy + 1)) && expect_text "said.$twin" "another runner works here (host " ;;
      *) fail "shard $number, runner $twin ended with $code: $(cat "said.$twin")" ;;
    esac
  done
done
[ "$busy" -gt 0 ] || fail "no two runners of a shard met"
same_as_reference out "two runners of each shard"
rm -r out

# Killed at random; what is missing is made by the shards again, or by a run of the whole.
kills=0
for round in $(seq "$(times 2 20)"); do
  for number in $(seq 7); do
    start "$program" run sweep.json --no-report --threads 1 --out out --shard "$number/7" \
      --checkpoint-seconds 0
    pause "$(between 10 400)"
    ! is_running "$runner" || kills=$((kills + 1))
    end_runner KILL
  done
  expect_code 0 "$program" status out
  if [ $((round % 2)) -eq 0 ]; then run_to_the_end sweep.json out --threads 2; else all_shards 7; fi
  cmp <(values_of out) <(values_of reference) || fail "round $round: other values"
  cmp <(beds_in out) <(beds_in reference) || fail "round $round: other beds"
  for table in reference/*.csv; do
    table=$(basename "$table")
    [ "$table" = packings.csv ] || cmp "reference/$table" "out/$table" || fail "round $round: other $table"
  done
  run_to_the_end sweep.json out --threads 2 # clears up what killed shards left half written
  nothing_is_left out "round $round"
  rm -r out
done
[ "$kills" -gt 0 ] || fail "every runner ended before it was killed"

# A run of the whole overlaps with any shard, and the shards of another division do.
start "$program" run sweep.json --no-report --threads 1 --out out --shard 1/2
wait_until has_packings out 1 || fail "ended too soon: $(cat said.txt)"
kill -STOP "$runner"
for other in "" "--shard 1/2" "--shard 3/7"; do
  expect_code 3 "$program" run sweep.json --no-report --out out $other
  expect_text error.txt "another runner works here (host " "process $runner"
done
shard 2 2 --alone
kill -CONT "$runner"
end_runner TERM
expect_text said.txt "Go on with: " " --shard 1/2"
expect_code 2 "$program" run sweep.json --out out --shard 1/2 --fresh --yes
expect_text error.txt "use it without --shard"
echo "1, 2, 7 and 64 shards, $busy twins and $kills kills: the tables and beds of one run"
