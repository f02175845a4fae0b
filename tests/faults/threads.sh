#!/usr/bin/env bash
# The runner under the thread sanitizer, in a build of its own (minutes): whole runs on eight threads,
# stopped ones, failing packings, the live line of a terminal. Its link compares the types of all
# sources: two of one name stop it. usage: threads.sh
set -euo pipefail
root=$(realpath "$(dirname "$0")/../..")
cd "$root"
cmake --preset thread --log-level=WARNING >/dev/null
cmake --build --preset thread >build/thread/build.log || {
  tail -n 30 build/thread/build.log >&2
  exit 1
}
source tests/faults/common.sh build/thread/runner/grainsweep
export TSAN_OPTIONS="suppressions=$root/tests/faults/threads.supp halt_on_error=0 exitcode=66"

# runs_clean CODES OPTION...: ends with one of CODES, and nothing is reported.
runs_clean() {
  local codes=$1 code=0
  shift
  "$program" run "$@" --threads 8 --checkpoint-seconds 0.05 >said.txt 2>&1 || code=$?
  is_clean "$codes" "$code" "$*"
}

is_clean() { # CODES CODE WHAT
  ! grep -q ThreadSanitizer said.txt || fail "$3: $(head -n 40 said.txt)"
  [[ " $1 " == *" $2 "* ]] || fail "$3: ended with $2: $(cat said.txt)"
  runs=$((runs + 1))
}

runs=0
write_small_sweep sweep.json
for number in $(seq "$(times 1 20)"); do
  rm -rf out stopped
  runs_clean "0 1" sweep.json --out out
  for signal in "TERM 143" "INT 130"; do
    read -r name expected <<<"$signal"
    start "$program" run sweep.json --out stopped --threads 8 --checkpoint-seconds 0
    wait_until has_packings stopped "$(between 0 3)" || true
    end_runner "$name"
    is_clean "0 1 $expected" "$code" "SIG$name"
  done
  runs_clean "0 1" sweep.json --out stopped
  cmp <(values_of out) <(values_of stopped) || fail "other values after stopping"
done

# Beds too low to be measured fail; the others go on, or stop with --fail-fast.
sed 's/"box.y": "periodic"/"measure.exclude_floor": 6/' sweep.json >failing.json
runs_clean 1 failing.json --out failing --fail-fast
runs_clean 1 failing.json --out failing --retry-failed

# One bed that is large enough to be shared by all threads, saved now and then.
cat >shared.json <<'JSON'
{ "name": "shared", "base": { "box": { "length": 30, "width": 30 }, "fill": { "grains": 16500 },
  "accuracy": { "preset": "fast", "max_steps": 55 } } }
JSON
start "$program" run shared.json --out shared --threads 8 --checkpoint-seconds 1
busy_threads=0
while is_running "$runner"; do
  now=$({ cat /proc/"$runner"/task/*/stat 2>/dev/null || true; } | awk '$14 > 20 { ++n } END { print n + 0 }')
  ((now <= busy_threads)) || busy_threads=$now # a thread that ends meanwhile cannot be read
  sleep 0.1
done
code=0
wait "$runner" || code=$?
is_clean "0 1" "$code" "a bed of 16,500 grains"
[ "$busy_threads" -ge 2 ] || fail "the large bed was made by $busy_threads thread"

code=0
TERM=xterm script -qec "'$program' run sweep.json --out live --threads 8" said.txt >/dev/null </dev/null ||
  code=$?
is_clean "0 1" "$code" "on a terminal"
grep -q $'\033\\[J' said.txt || fail "no live line on a terminal: $(cat said.txt)"
echo "$runs runs on eight threads under the thread sanitizer: nothing reported"
