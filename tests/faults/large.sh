# A sweep of 100,000 packings: plan and status in 2 s, collect in 60 s, each in 300 MB, whether none
# or all of it is done, by 64 shards into one folder, in 200 files at most. Making them would take
# too long: journals and beds are made from one tiny packing. status looks whether every bed is
# there; collect reads each of them, and writes tables and page.
source "$(dirname "$0")/common.sh" "$1"
command -v python3 >/dev/null || skip "python3 is not installed"
cat >large.json <<'JSON'
{ "name": "large", "replicates": 100,
  "base": { "box": { "length": 3, "width": 3 }, "fill": { "solid_height": 4 },
            "measure": { "exclude_floor": 0, "exclude_surface": 1 }, "accuracy": "fast" },
  "sweep": [ { "random": { "count": 1000, "box.width": { "uniform": [3, 4] } } } ] }
JSON

# measured SECONDS COMMAND...: CPU time and peak memory stay below the limits; shows both. The
# seconds are those of an idle core, and other work of the machine only adds to them: the least of
# up to three tries counts.
measured() {
  local limit=$1
  shift
  python3 - "$limit" "$program" "$@" <<'PYTHON' || fail "$*: too slow or too large"
import os, resource, subprocess, sys
limit, command = float(sys.argv[1]), sys.argv[2:]
used = 0
for _ in range(3):
    with open("said.txt", "w") as said:
        code = subprocess.call(command, stdout=said, stderr=subprocess.STDOUT)
    use = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds, megabytes = use.ru_utime + use.ru_stime - used, use.ru_maxrss / 1024
    used += seconds
    print(f"{' '.join(command[1:])}: {seconds:.2f} s, {megabytes:.0f} MB")
    if code != 0 or seconds < limit:
        break
sys.exit(code != 0 or seconds >= limit or megabytes >= 300)
PYTHON
}

measured 2 plan large.json
expect_text said.txt "100000 packings"
measured 2 plan large.json --json
"$program" run large.json --out out --threads 2 --no-grains >/dev/null 2>&1 &
for _ in $(seq 300); do has_packings out 1 && break || sleep 0.1; done
kill -KILL $! && wait $! 2>/dev/null || true
measured 2 status out
expect_text said.txt "of 100000 packings done"

python3 - out <<'PYTHON'
import json, os, struct, sys, zlib
folder = sys.argv[1]
journal = folder + "/shards/1-of-1.jsonl"
line = next(line for line in open(journal, "rb") if b'"outcome":' in line)
outcome = line[line.index(b'"outcome":') + len(b'"outcome":'):-2]
facts = json.loads(outcome)
job, place = facts["job"].encode(), b'"stored_at":%d' % facts["stored_at"]
with open(folder + "/shards/1-of-1.beds", "rb") as file:
    file.seek(facts["stored_at"])
    before, _, after = file.read(facts["stored_bytes"])[:-4].partition(job)  # without its CRC-32
shards = [f"{folder}/shards/{number}-of-64" for number in range(1, 65)]
journals = [open(shard + ".jsonl", "wb") for shard in shards]
beds = [open(shard + ".beds", "wb") for shard in shards]
for number, other in enumerate(json.load(open(folder + "/provenance.json"))["sweep"]["jobs"]):
    name = other["id"].encode()
    bed = before + name + after
    text = outcome.replace(b'"job":"' + job, b'"job":"' + name)
    text = text.replace(place, b'"stored_at":%d' % beds[number % 64].tell())
    line = b'{"length":%d,"crc32":"%08x","outcome":%s}\n' % (len(text), zlib.crc32(text), text)
    journals[number % 64].write(line)
    beds[number % 64].write(bed + struct.pack("<I", zlib.crc32(bed)))
os.remove(journal)
os.remove(folder + "/shards/1-of-1.beds")
PYTHON
files=$(find out -type f | wc -l)
[ "$files" -le 200 ] || fail "$files files hold the sweep"
echo "64 journals: $(cat out/shards/*.jsonl | wc -c | awk '{ printf "%d", $1 / 1e6 }') MB; $files files in all"
measured 2 status out
expect_text said.txt "100000 of 100000 packings done"
! grep -q warning said.txt || fail "a bed that is there is told as missing"
measured 60 collect out --out all
expect_text said.txt "100000 packings added to all, which now holds 100000 of 100000"
! grep -q warning said.txt || fail "collect warns: $(grep warning said.txt)"
[ "$(wc -l <all/packings.csv)" -eq 100001 ] || fail "packings.csv lacks packings"
