#!/bin/bash
# 16 shards as an array: qsub -v SWEEP=SWEEP.json,DIR=DIR pbs.sh
#PBS -J 1-16
#PBS -l select=1:ncpus=4
#PBS -l walltime=1:00:00
cd "$PBS_O_WORKDIR"
exec grainsweep run "$SWEEP" --out "$DIR" --shard auto/16 --threads 4 --time-limit 58:00 --tolerate-unsettled
