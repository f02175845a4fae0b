#!/usr/bin/env bash
# Measures what `plan` estimates: a scene of each kind in bench/costs.json, or the packings of other
# sweeps; of one that takes longer than a minute by its estimate a part of about that length, in which
# there are packings of all kinds. Prints a table of estimated and measured CPU seconds. Packings that
# an earlier call made are not made again.
# usage: bench/costs.sh [FOLDER [SWEEP.json...]]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root folder=${1:-out/costs}
shift || true
(($#)) || set -- "$root/bench/costs.json"

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep >/dev/null
readonly grainsweep=$root/build/release/runner/grainsweep

for sweep in "$@"; do
  out=$folder/$(basename "$sweep" .json)
  mkdir -p "$out"
  "$grainsweep" plan "$sweep" --json >"$out/plan.json"
  parts=$(python3 -c 'import json, sys
jobs = json.load(open(sys.argv[1]))["jobs"]
print(min(len(jobs), 1 + int(sum(job["estimated_cpu_seconds"] for job in jobs) / 60)))' "$out/plan.json")
  "$grainsweep" run "$sweep" --out "$out" --shard "1/$parts" --threads 1 --quiet --no-report \
    --tolerate-unsettled
  python3 - "$out" <<'PYTHON'
import glob, json, sys
folder = sys.argv[1]
took = {}
for journal in glob.glob(folder + "/shards/*.jsonl"):
    for line in open(journal):
        outcome = json.loads(line).get("outcome")
        if outcome:
            took[outcome["job"]] = outcome["cpu_seconds"]
sums = {}
for job in json.load(open(folder + "/plan.json"))["jobs"]:
    if job["job"] not in took:
        continue
    of_label = sums.setdefault(job["label"], [0, 0.0, 0.0])
    of_label[0] += job["grains"]
    of_label[1] += job["estimated_cpu_seconds"]
    of_label[2] += took[job["job"]]
sums[folder + ", all"] = [sum(column) for column in zip(*sums.values())]
print("| scene | grains | estimated, s | measured, s | ratio |\n|---|---|---|---|---|")
for label, (grains, estimated, measured) in sums.items():
    print(f"| {label} | {grains} | {estimated:.2f} | {measured:.2f} | {estimated / measured:.2f} |")
PYTHON
done
