#!/usr/bin/env bash
# Makes the 300 packings of bench/shards.json by so many runners at once, each a shard of them, with and
# without help of those that have ended, and prints how far the CPU time of the packings that the busiest
# runner made lies above the mean. Runners of one machine wait for its cores, those of a cluster do not.
# usage: bench/shards.sh [FOLDER [SHARDS [PRESET [RUNS]]]]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root folder=${1:-out/shards} shards=${2:-64} preset=${3:-balanced} runs=${4:-5}

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep >/dev/null
mkdir -p "$folder"
readonly program=$root/build/release/runner/grainsweep made=$folder/made

make_by_shards() {  # SWEEP [--alone]
  local runners=() runner
  rm -rf "$made"
  for number in $(seq "$shards"); do
    "$program" run "$1" --out "$made" --shard "$number/$shards" --threads 1 --quiet --no-report \
      --no-grains ${2:-} &
    runners+=($!)
  done
  for runner in "${runners[@]}"; do wait "$runner"; done # fails with the runner
}

# CPU time of each runner's packings, s, in a line.
loads() {
  python3 - "$made" <<'PYTHON'
import glob, json, sys
for journal in glob.glob(sys.argv[1] + "/shards/*.jsonl"):
    lines = [json.loads(line) for line in open(journal)]
    print(sum(line["outcome"]["cpu_seconds"] for line in lines if "outcome" in line), end=" ")
print()
PYTHON
}

for seed in 5 6 7; do
  sweep=$folder/$preset-$seed.json
  python3 -c 'import json, sys
sweep = json.load(open(sys.argv[1]))
del sweep["$schema"]
sweep["seed"], sweep["base"]["accuracy"] = int(sys.argv[2]), sys.argv[3]
json.dump(sweep, open(sys.argv[4], "w"))' "$root/bench/shards.json" "$seed" "$preset" "$sweep"
  for help in "--alone" ""; do
    # Who helps whom depends on when runners end.
    for ((run = 0; run < runs; ++run)); do
      make_by_shards "$sweep" $help
      loads
    done | python3 -c 'import statistics, sys
means, busiest = [], []
for line in sys.stdin:
    loads = [float(load) for load in line.split()]
    means.append(statistics.mean(loads))
    busiest.append(100 * (max(loads) / means[-1] - 1))
print(f"seed {sys.argv[1]} {sys.argv[2]}: {len(loads)} shards, {statistics.median(means):.3g} s of CPU each, "
      f"busiest {statistics.median(busiest):+.0f} % (from {min(busiest):+.0f} to {max(busiest):+.0f})")
' "$seed" "${help:-with help}"
  done
done
