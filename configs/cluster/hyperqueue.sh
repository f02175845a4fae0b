#!/bin/bash
# 64 shards as tasks of HyperQueue: bash hyperqueue.sh SWEEP.json DIR
hq submit --array 1-64 --cpus 4 --crash-limit 3 \
  grainsweep run "$1" --out "$2" --shard auto/64 --threads 4 --tolerate-unsettled
