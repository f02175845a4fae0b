# The same sweep gives the same bytes on any number of threads and any instruction set: spheres,
# shapes, f32 and f64, small beds and a large one, whose parts are shared by several threads.
source "$(dirname "$0")/common.sh" "$1"
cat >sweep.json <<'JSON'
{ "name": "kinds", "seed": 3,
  "base": { "box": { "length": 5, "width": 4, "x": "periodic", "y": "walls" },
            "fill": { "solid_height": 3 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 }, "accuracy": "fast" },
  "sweep": [
    { "label": "spheres", "grid": { "accuracy.precision": ["f32", "f64"], "box.width": [3, 5] } },
    { "label": "bulk", "set": { "box.y": "periodic", "sizes.small_share": 0.25 } },
    { "label": "pinacoids", "set": { "shape": "pinacoid", "box.length": 4 },
                            "grid": { "accuracy.precision": ["f32", "f64"] } },
    { "label": "shared ring", "set": { "box.length": 60, "box.width": 30, "box.y": "periodic",
                                       "fill": { "grains": 20000 }, "accuracy.max_steps": 31 } } ] }
JSON
readonly packings=8

find_isas

# Each number of threads with another instruction set, in turn.
number=0 made=()
for threads in 1 2 8; do
  isa=${isas[number % ${#isas[@]}]} code=0
  number=$((number + 1))
  "$program" run sweep.json --out $number --threads $threads --isa "$isa" --no-report >/dev/null 2>error.txt || code=$?
  [ "$code" -le 1 ] || fail "run ended with $code: $(cat error.txt)"
  grep -q "\"isa\": \"$isa\"" $number/provenance.json || fail "$isa was not used"
  values_of $number >values-$number.txt
  [ "$(beds_in $number | wc -l)" -eq "$packings" ] || fail "packings failed: $(cat values-$number.txt)"
  made+=("$threads threads of $isa")
  cmp values-1.txt values-$number.txt || fail "${made[0]} and ${made[-1]} differ"
  cmp <(beds_in 1) <(beds_in $number) || fail "grains of ${made[0]} and ${made[-1]} differ"
done
printf 'the same bits: %s\n' "${made[*]}"
