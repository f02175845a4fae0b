#!/bin/bash
# 64 shards as an array: sbatch slurm-array.sh SWEEP.json DIR
#SBATCH --array=1-64
#SBATCH --cpus-per-task=4
#SBATCH --time=1:00:00
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:TERM@90
exec grainsweep run "$1" --out "$2" --shard auto --threads 4 --tolerate-unsettled
