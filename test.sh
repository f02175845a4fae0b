#!/usr/bin/env bash
# Sets up, builds everything and runs the tests. See usage below.
set -euo pipefail

usage() {
  cat <<'EOF'
usage: ./test.sh [--fast] [--sanitize] [-- CTEST-OPTIONS...]

Builds grainsweep with all tests and benchmarks in build/release and runs every test.

  --fast       only the tests of seconds (label fast); leaves out the slow physics and the checks
  --sanitize   in a second build, build/sanitize, by clang under the address and
               undefined-behaviour sanitizers; takes several times as long, so mostly together
               with --fast
  --help       this text
  --           what follows goes to ctest, e.g.  ./test.sh -- -R "carries its weight" -V

Labels: fast, slow (physics, seconds to minutes), extremes (scenes with known answers), checks
(folder order, kernel objects, scripts), faults (kills, full disks, failing system calls, fuzzing ...;
tests/faults/run.sh --full tries more).
Every change is expected to pass .ci/run, which runs all of it.
EOF
}

root=$(dirname "$(readlink -f "$0")")
readonly root
preset=release
setup_options=()
ctest_options=(--parallel "$(nproc)")
while (($#)); do
  case $1 in
    --fast) ctest_options+=(--label-regex '^fast$') ;;
    --sanitize) preset=sanitize setup_options=(--checks) ;;
    -h | --help) usage && exit 0 ;;
    --) shift && ctest_options+=("$@") && break ;;
    *) usage >&2 && printf 'test.sh: unknown option %s\n' "$1" >&2 && exit 2 ;;
  esac
  shift
done

"$root/setup.sh" "${setup_options[@]}"
cd "$root"
mkdir -p "build/$preset"
exec 9>"build/$preset/.lock"
flock 9 # one build at a time
cmake --preset "$preset" --log-level=WARNING
cmake --build --preset "$preset"
exec 9>&-
ctest --preset "$preset" "${ctest_options[@]}"
