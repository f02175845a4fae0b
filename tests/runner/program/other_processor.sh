# The same sweep gives the same beds where the C library takes its functions without fused
# multiply-adds, as it does on processors that have none: of all that sizes, shapes and starts are
# made of, and of points at random. Of what is measured last digits may differ, where rings of
# tubes and pair correlations take those functions.
source "$(dirname "$0")/common.sh" "$1"
cat >sweep.json <<'JSON'
{ "name": "kinds", "seed": 3, "replicates": 3,
  "base": { "box": { "length": 5, "width": 5 }, "fill": { "grains": 700 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 },
            "accuracy": { "preset": "fast", "max_steps": 110 } },
  "sweep": [
    { "label": "two sizes", "grid": { "sizes.small_share": [0.2, 0.4] } },
    { "label": "lognormal", "set": { "sizes.distribution": { "lognormal": { "sigma": 0.2 } } } },
    { "label": "Weibull", "set": { "sizes.distribution": { "weibull": { "shape": 4 } } } },
    { "label": "zigzag", "set": { "tube.diameter": 1.8, "fill": { "grains": 50 } } },
    { "label": "at random", "random": { "count": 5, "box.width": { "log_uniform": [5, 9] } } },
    { "label": "pinacoids", "replicates": 1, "set": { "shape": { "pinacoid": { "angle_deg": 61 } } } },
    { "label": "prisms", "replicates": 1, "set": { "shape": { "prism": { "sides": 7 } } } },
    { "label": "cylinders", "replicates": 1, "set": { "shape": { "cylinder": {} } } } ] }
JSON

export GLIBC_TUNABLES=
for processor in this "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4"; do
  folder=${processor%%.*} code=0
  [ "$folder" = this ] || GLIBC_TUNABLES=$processor
  "$program" run sweep.json --out "$folder" --no-report --quiet >/dev/null 2>error.txt || code=$?
  [ "$code" -le 1 ] || fail "run ended with $code: $(cat error.txt)"
  awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "state_hash") at = k } { print $1, $at }' \
    "$folder/packings.csv" >"$folder.txt"
done
[ "$(wc -l <this.txt)" -eq 34 ] || fail "not 33 beds under a line of names: $(wc -l <this.txt)"
cmp this.txt glibc.txt || fail "beds differ where the C library takes no fused multiply-adds"
