#!/bin/bash
# 16 shards on the machines of a file, by GNU parallel: bash parallel.sh SWEEP.json DIR MACHINES [THREADS]
# A line of MACHINES is "2/node7", two shards at once on node7, each on THREADS cores (1); all see the same
# folders. ":" is this machine.
set -e
seq 16 | parallel --quote --sshloginfile "$3" --wd . --halt never \
  grainsweep run "$1" --out "$2" --shard {}/16 --threads "${4:-1}" --tolerate-unsettled
