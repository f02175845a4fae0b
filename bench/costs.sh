#!/usr/bin/env bash
# Measures what `plan` estimates: a scene of each kind in bench/costs.json, or the packings of other
# sweeps. Prints a table of estimated and measured CPU seconds; 2 minutes of CPU. Packings that an
# earlier call made are not made again.
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
  "$grainsweep" run "$sweep" --out "$out" --threads 1 --quiet --no-report --tolerate-unsettled
  "$grainsweep" plan "$sweep" --json >"$out/plan.json"
  python3 - "$out" <<'PYTHON'
import csv, json, sys
folder = sys.argv[1]
took = {row["job"]: float(row["cpu_seconds"]) for row in csv.DictReader(open(folder + "/packings.csv"))}
sums = {}
for job in json.load(open(folder + "/plan.json"))["jobs"]:
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
