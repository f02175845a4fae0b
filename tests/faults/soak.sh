# Twenty thousand tiny packings in one process: after the first of them neither memory nor
# descriptors grow.
source "$(dirname "$0")/common.sh" "$1"
packings=20000
warm=1000
cat >sweep.json <<JSON
{ "name": "soak", "replicates": $((packings / 2)), "base": { "box": { "length": 2.7 },
  "fill": { "grains": 16 }, "accuracy": { "preset": "fast", "max_steps": 20 },
  "measure": { "exclude_floor": 0, "exclude_surface": 0, "bin_width": 2.7 } },
  "sweep": [ { "grid": { "box.width": [2.7, 3] } } ] }
JSON
# Where flushing is free: this is about the process, not the disk.
folder=$([ -d /dev/shm ] && [ -w /dev/shm ] && mktemp -d /dev/shm/grainsweep-soak.XXXXXX || mktemp -d)
trap 'rm -rf "$folder" "$here"' EXIT

resident() { awk '/^VmRSS:/ { print $2 }' "/proc/$1/status" 2>/dev/null || true; }
descriptors() { { ls "/proc/$1/fd" 2>/dev/null || true; } | wc -l; }

: >said.txt
"$program" run sweep.json --no-report --threads 2 --out "$folder/out" >said.txt 2>&1 &
runner=$!
first_memory=0 last_memory=0 most_descriptors=0 least_descriptors=1000 seen=0
while is_running $runner && [ "$seen" -lt $((packings * 98 / 100)) ]; do
  seen=$(grep -c '^[0-9]*/' said.txt || true)
  memory=$(resident $runner)
  open=$(descriptors $runner)
  if [ "$seen" -ge "$warm" ] && [ -n "$memory" ] && [ "$seen" -lt $((packings * 98 / 100)) ]; then
    [ "$first_memory" -gt 0 ] || first_memory=$memory first_seen=$seen
    last_memory=$memory last_seen=$seen
    ((open <= most_descriptors)) || most_descriptors=$open
    ((open >= least_descriptors)) || least_descriptors=$open
  fi
  sleep 0.1
done
code=0
wait $runner || code=$?
[ "$code" -le 1 ] || fail "ended with $code: $(tail -n 5 said.txt)"
[ "$first_memory" -gt 0 ] && [ "$last_seen" -gt $((2 * warm)) ] || fail "was not seen at work"
growth=$(((last_memory - first_memory) * 1000 / first_memory))
# A packing stores its grains, then its line: at most a file and its folder per thread at a time.
[ $((most_descriptors - least_descriptors)) -le 4 ] ||
  fail "from $least_descriptors to $most_descriptors descriptors"
[ "$growth" -lt 10 ] || fail "memory grew from $first_memory kB to $last_memory kB"
echo "$packings packings: from the ${first_seen}th to the ${last_seen}th $first_memory kB -> $last_memory kB, $least_descriptors to $most_descriptors descriptors"
