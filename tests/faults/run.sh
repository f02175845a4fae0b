#!/usr/bin/env bash
# Runs every fault: few tries of each as in ctest, or all of them. See usage below.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: tests/faults/run.sh [--full] [FAULT...]

Runs the faults on build/release, which has to be built (./test.sh does it), and ends with a table.
FAULTs: kills signals injected flushed full_disk surroundings corruption damage runners shards slurm
one_hash soak large overhead, and, each in a build of its own that takes minutes, threads (thread sanitizer)
and fuzz (libFuzzer, clang).

  --full   all tries: a thousand kills, every system call failing, two million fuzzed sweep files,
           20,000 packings in one process ...; takes about half an hour
TEXT
}

here=$(dirname "$(readlink -f "$0")")
readonly program=$here/../../build/release/runner/grainsweep
faults=()
while (($#)); do
  case $1 in
    --full) export GRAINSWEEP_FAULTS=full ;;
    -h | --help) usage && exit 0 ;;
    -*) usage >&2 && printf 'run.sh: unknown option %s\n' "$1" >&2 && exit 2 ;;
    *) faults+=("$1") ;;
  esac
  shift
done
((${#faults[@]})) ||
  faults=(kills signals injected flushed full_disk surroundings corruption damage runners shards slurm
    one_hash soak large overhead threads fuzz)

summary=()
failures=0
for fault in "${faults[@]}"; do
  began=$SECONDS outcome=ok
  printf '=== %s\n' "$fault"
  bash "$here/$fault.sh" "$program" || outcome=$([[ $? == 77 ]] && echo skipped || echo FAILED)
  [[ $fault != corruption ]] || "$here/../../build/release/tests/faults/test_faults" || outcome=FAILED
  [[ $outcome != FAILED ]] || failures=$((failures + 1))
  summary+=("$(printf '%-8s %6d s  %s' "$outcome" $((SECONDS - began)) "$fault")")
done
printf '%s\n' "${summary[@]}"
((failures == 0))
