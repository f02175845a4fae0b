#!/bin/bash
# 16 shards as tasks of HyperQueue: bash hyperqueue.sh SWEEP.json DIR
hq submit --array 1-16 --cpus 4 --crash-limit 3 \
  grainsweep run "$1" --out "$2" --shard auto/16 --threads 4 --tolerate-unsettled
