#!/bin/bash
# 64 shards as an array: qsub grid-engine.sh SWEEP.json DIR
#$ -t 1-64
#$ -pe smp 4
#$ -l h_rt=1:00:00
#$ -cwd
#$ -r y
exec grainsweep run "$1" --out "$2" --shard auto --threads 4 --time-limit 58:00 --tolerate-unsettled
