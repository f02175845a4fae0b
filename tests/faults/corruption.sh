# Journals and checkpoints damaged on the disk between two runs: redone, never used.
source "$(dirname "$0")/common.sh" "$1"
cat >long.json <<'JSON'
{ "name": "long", "replicates": 3, "base": { "box": { "length": 6, "width": 6 },
  "fill": { "solid_height": 8 }, "accuracy": "fast" } }
JSON
make_reference long.json

# damage FILE: flips a bit of a random byte, or cuts the file at it.
damage() {
  local size at
  size=$(stat -c %s "$1")
  draw at 0 $((size - 1))
  if [ $((RANDOM % 2)) -eq 0 ]; then
    truncate -s "$at" "$1"
  else
    flip_bit "$1" "$at" $((RANDOM % 8))
  fi
}

# A packing is finished, and another under way has both its checkpoints.
is_damageable() {
  local files=(out/checkpoints/*.0)
  has_packings out 1 && [ -e "${files[0]%.0}.1" ] && [ -e "${files[0]}" ]
}

damaged=0 gone_on=0
tries=$(times 8 80)
for number in $(seq "$tries"); do
  for kill in $(seq 20); do
    rm -rf out
    start "$program" run long.json --no-report --threads 2 --out out --checkpoint-seconds 0
    wait_until is_damageable || true
    end_runner KILL
    ! is_damageable || break
  done
  is_damageable || fail "no kill in 20 left a packing and two checkpoints of another"
  # One of the two checkpoints of each bed, every third time both, and a journal.
  for file in out/checkpoints/*.$((number % 2)) out/shards/*.jsonl; do
    [ ! -s "$file" ] || { damage "$file" && damaged=$((damaged + 1)); }
  done
  for file in out/checkpoints/*.$(((number + 1) % 2)); do
    [ ! -s "$file" ] || [ $((number % 3)) -ne 0 ] || damage "$file"
  done
  run_to_the_end long.json out --threads 2
  ! grep -q 'went on from step' said.txt || gone_on=$((gone_on + 1))
  cmp <(values_of out) <(values_of reference) || fail "try $number: other values"
  cmp <(beds_in reference) <(beds_in out) || fail "try $number: other grains"
  nothing_is_left out "try $number"
done
[ "$damaged" -ge $((2 * tries)) ] || fail "only $damaged files were damaged"
[ "$gone_on" -gt 0 ] || fail "no run went on from the other checkpoint"
echo "$damaged damaged files in $tries runs, $gone_on went on from another checkpoint: the same bytes"
