# Any number of threads, any instruction set, any order of the jobs, killed and resumed: one hash.
source "$(dirname "$0")/common.sh" "$1"

# write_shuffled FILE: the sweep of all tries, its jobs in random order.
write_shuffled() {
  local widths blocks
  widths=$(shuf -e 3 4 5 | paste -sd,)
  blocks=$(shuf -e '{"label": "walls", "grid": {"box.width": ['"$widths"']}}' \
    '{"label": "bulk", "set": {"box.width": 5, "box.y": "periodic"}}' \
    '{"label": "two sizes", "set": {"box.width": 4, "sizes.small_share": 0.25}}' \
    '{"label": "f64", "replicates": 1, "set": {"box.width": 4, "accuracy.precision": "f64"}}' \
    '{"label": "shapes", "replicates": 1, "set": {"box.width": 3, "shape": "pinacoid"}}' | paste -sd,)
  cat >"$1" <<JSON
{ "name": "shuffled", "seed": 9, "replicates": 5,
  "base": { "box": { "length": 4 }, "fill": { "solid_height": 4 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 }, "accuracy": "fast" },
  "sweep": [ $blocks ] }
JSON
}

# without_numbers: a table without the columns that number groups and families in the sweep's order.
without_numbers() {
  awk -F, -v OFS=, 'NR == 1 { for (k = 1; k <= NF; ++k) drop[k] = $k == "group" || $k == "family" }
    { row = ""; for (k = 1; k <= NF; ++k) if (!drop[k]) row = row OFS $k; print row }'
}

# One hash over the rows of packings.csv in the order of the ids, without CPU times, and the grains.
hash_of() {
  { values_of "$1" | without_numbers | sort && beds_in "$1"; } | sha256sum | cut -c1-16
}

find_isas

# kill_times COUNT: kills a run COUNT times before it ends; false if it came to its end.
kill_times() {
  local number
  rm -rf out
  for number in $(seq "$1"); do
    start "$program" run sweep.json --no-report --out out "${options[@]}"
    wait_until has_packings out "$(between $((8 * number - 8)) $((8 * number)))" || true
    end_runner KILL
    [ "$code" -eq 137 ] || return 1
  done
}

expected="" killed=0
tries=$(times 12 60)
for number in $(seq 0 $((tries - 1))); do
  threads=$((number % 3)) && threads=$((threads == 0 ? 1 : threads == 1 ? 2 : 8))
  isa=${isas[number / 3 % ${#isas[@]}]}
  options=(--threads $threads --isa "$isa" --checkpoint-seconds 0.02)
  write_shuffled sweep.json
  for again in $(seq 20); do ! kill_times $((number % 3)) || break; done
  [ $((number % 3)) -eq 0 ] || [ "$code" -eq 137 ] || fail "no run in 20 was killed before its end"
  killed=$((killed + number % 3))
  run_to_the_end sweep.json out "${options[@]}"
  hash=$(hash_of out)
  [ -n "$expected" ] || expected=$hash
  [ "$hash" = "$expected" ] || fail "other bits with ${options[*]}, killed $((number % 3)) times"
done
echo "$tries runs on 1, 2 and 8 threads with ${isas[*]}, shuffled, $killed kills: one hash, $expected"
