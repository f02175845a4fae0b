#!/usr/bin/env bash
# Fuzzes the sweep reader with libFuzzer under the address and undefined-behaviour sanitizers, from
# a fixed corpus and seed. GRAINSWEEP_FAULTS=full: two million inputs instead of a hundred thousand.
# Its build takes minutes, so ctest runs test_any_text.cpp instead.
# usage: fuzz.sh
set -euo pipefail
cd "$(dirname "$0")/../.."
if ! clang++ -x c++ -fsyntax-only /dev/null 2>/dev/null ||
  [[ ! -e $(clang++ -print-resource-dir)/lib/linux/libclang_rt.fuzzer-x86_64.a ]]; then
  echo "SKIPPED: clang++ with libFuzzer is not installed (setup.sh --checks installs it)"
  exit 77
fi
runs=100000
[[ ${GRAINSWEEP_FAULTS:-} != full ]] || runs=2000000

cmake --preset fuzz --log-level=WARNING >/dev/null
cmake --build --preset fuzz >build/fuzz/build.log || {
  tail -n 30 build/fuzz/build.log >&2
  exit 1
}

work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-fuzz.XXXXXX")
trap 'rm -rf "$work"' EXIT
mkdir "$work/corpus"

# The corpus: the sweeps at hand, and one of every kind of block. The words: the keys of the schema.
cp configs/*.json "$work/corpus/" && rm "$work/corpus/"*.{schema,reference}.json
sed -n '/^```json$/,/^```$/{/^```/d;p}' configs/README.md >"$work/corpus/readme.json"
cp tests/faults/kinds.json "$work/corpus/"
grep -oE '"[A-Za-z_.$]+":' configs/sweep.schema.json | tr -d '":' | sort -u |
  sed 's/.*/"\\"&\\""/' >"$work/words"
printf '%s\n' '"\\"walls\\""' '"\\"periodic\\""' '"\\"fast\\""' '"\\"choice\\""' '"1e308"' '"-0"' \
  '"18446744073709551615"' '"\\u0000"' '"[["' '"{}"' >>"$work/words"

cd "$work"
ASAN_OPTIONS=detect_leaks=1 "$OLDPWD/build/fuzz/tests/faults/fuzz_sweep" -seed=20130708 -runs="$runs" \
  -max_len=4096 -timeout=1 -rss_limit_mb=2048 -dict=words -print_final_stats=1 \
  -artifact_prefix="$OLDPWD/build/fuzz/found-" corpus >log.txt 2>&1 </dev/null || {
  tail -n 40 log.txt >&2
  printf 'fuzz: failed; the input is kept as %s\n' "$OLDPWD"/build/fuzz/found-* >&2
  exit 1
}
grep -E '^(Done|stat::(number_of_executed_units|average_exec_per_sec|slowest_unit_time_sec))' log.txt
