#!/usr/bin/env bash
# Makes the 300 packings of bench/shards.json by so many runners at once, each a shard of them, with and
# without help of those that have ended, and prints how far the CPU time of the packings that the busiest
# runner made lies above the mean. Runners of one machine wait for its cores, those of a cluster do not.
# usage: bench/shards.sh [FOLDER [SHARDS [PRESET]]]
set -euo pipefail
root=$(dirname "$(dirname "$(readlink -f "$0")")")
readonly root folder=${1:-out/shards} shards=${2:-64} preset=${3:-balanced}

cmake -S "$root" --preset release >/dev/null
cmake --build "$root/build/release" --target grainsweep >/dev/null
mkdir -p "$folder"
for seed in 5 6 7; do
  sweep=$folder/$preset-$seed.json
  python3 -c 'import json, sys
sweep = json.load(open(sys.argv[1]))
del sweep["$schema"]
sweep["seed"], sweep["base"]["accuracy"] = int(sys.argv[2]), sys.argv[3]
json.dump(sweep, open(sys.argv[4], "w"))' "$root/bench/shards.json" "$seed" "$preset" "$sweep"
  for help in --alone ""; do
    out=$folder/made
    rm -rf "$out"
    for number in $(seq "$shards"); do
      "$root/build/release/runner/grainsweep" run "$sweep" --out "$out" --shard "$number/$shards" \
        --threads 1 --quiet --no-report --no-grains $help &
    done
    wait
    python3 - "$out" "seed $seed ${help:-with help}" <<'PYTHON'
import glob, json, sys
loads = []
for journal in glob.glob(sys.argv[1] + "/shards/*.jsonl"):
    lines = [json.loads(line) for line in open(journal)]
    loads.append(sum(line["outcome"]["cpu_seconds"] for line in lines if "outcome" in line))
mean = sum(loads) / len(loads)
print(f"{sys.argv[2]}: {len(loads)} shards, {mean:.3g} s of CPU each, "
      f"busiest {100 * (max(loads) / mean - 1):+.0f} %, idlest {100 * (min(loads) / mean - 1):+.0f} %")
PYTHON
  done
done
