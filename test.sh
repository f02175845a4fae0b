#!/usr/bin/env bash
# Sets up, builds everything and runs the tests. See usage below.
set -euo pipefail

usage() {
  cat <<'EOF'
usage: ./test.sh [--fast] [--sanitize] [--build] [-- CTEST-OPTIONS...]

Builds grainsweep with all tests and benchmarks in build/release and runs every test.

  --fast       only the tests of seconds (label fast); leaves out the slow physics and the checks
  --sanitize   in a second build, build/sanitize, by clang under the address and
               undefined-behaviour sanitizers; takes several times as long, so mostly together
               with --fast
  --build      only builds
  --help       this text
  --           what follows goes to ctest, e.g.  ./test.sh -- -R "carries its weight" -V

Labels: fast, slow, extremes, checks, faults; tests/README.md says what they are and how to add a
test. Every change is expected to pass .ci/run, which runs all of them.
EOF
}

root=$(dirname "$(readlink -f "$0")")
readonly root
preset=release
setup_options=()
test=1
ctest_options=(--parallel $(($(nproc) + 2))) # two of them often wait
while (($#)); do
  case $1 in
    --fast) ctest_options+=(--label-regex '^fast$') ;;
    --build) test=0 ;;
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
((test == 0)) || ctest --preset "$preset" "${ctest_options[@]}"
