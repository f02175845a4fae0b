# Bad input: exit code 2, a message with its place, and nothing written.
source "$(dirname "$0")/common.sh" "$1"

refused() {
  expect_code 2 "$@"
  [ ! -e out ] || fail "something was written: $*"
  [ -s error.txt ] || fail "no message: $*"
}

refused "$program" run missing.json
expect_text error.txt "missing.json"

echo '{ "name": "a", "sede": 1 }' >unknown.json
refused "$program" run unknown.json
expect_text error.txt "unknown.json:1:" "sede" "seed"

printf '{ "name": "a",\n  "base": { "box": { "width": 0.5 } } }' >narrow.json
refused "$program" run narrow.json
expect_text error.txt "narrow.json:2:" "width"

printf '{ "name": "a",\n  "base": { "box": { "width": 5 },\n  "measure": { "bin_width": 6 } } }' >bins.json
refused "$program" run bins.json
expect_text error.txt "bins.json:3:" "measure/bin_width: must lie in [0.01, 5]" "is 6"

printf '{ "name": "a",\n  "base": { "sizes": { "small_share": 1.4,\n  "size_ratio": 0 } } }' >sizes.json
refused "$program" run sizes.json
expect_text error.txt "sizes.json:2:" "small_share: must lie in [0, 1], is 1.4" \
  "sizes.json:3:" "size_ratio: must lie in (0.02, 1], is 0"

printf '{ "name": "a", ' >cut.json
refused "$program" run cut.json --out out
expect_text error.txt "cut.json:1:"

printf '{ "name": "a", "seed": NaN }' >nan.json
refused "$program" validate nan.json

write_sweep right.json 1
refused "$program" run right.json --isa avx9
expect_text error.txt "--isa" "avx9" "sse2"
refused env GRAINSWEEP_ISA=mmx "$program" run right.json
expect_text error.txt "GRAINSWEEP_ISA" "mmx"
refused "$program" run right.json --threads 0
refused "$program" run right.json --out
refused "$program" run right.json --unknown
refused "$program" walk right.json
refused "$program" report nowhere
expect_text error.txt "nowhere" "grainsweep run"
refused "$program" compare nowhere
expect_text error.txt "nowhere" "grainsweep run"
refused "$program" export . --format csv
refused "$program" status .

[ -z "$(ls -A | grep -v -E '\.(json|txt)$')" ] || fail "something else was written: $(ls -A)"
echo "bad input is refused"
