#!/usr/bin/env bash
# Everything that .ci/run does, with as many tries as are worth a night: a thousand kills, every
# system call failing, two million fuzzed sweep files, 160 beds for each symmetry. Takes an hour or
# two. usage: tests/run_full.sh
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."
export GRAINSWEEP_FAULTS=full
status=0
.ci/run || status=1
tests/faults/fuzz.sh || status=1
exit $status
