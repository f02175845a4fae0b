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

# Work of the same kind (JSON, checksums, many small objects) that an idle core of 3 GHz does in
# about a second.
cat >second.py <<'PYTHON'
import json, zlib
text = json.dumps([{"id": "%016x" % i, "value": i / 7} for i in range(100000)])
for _ in range(5):
    json.loads(text)
    zlib.crc32(text.encode())
PYTHON

# measured SECONDS COMMAND...: CPU time and peak memory stay below the limits; shows both. The
# seconds are those of an idle core of 3 GHz: they last as long as second.py takes before and after
# the command, so that a slower or a busy machine does not count. Of up to three tries the least.
measured() {
  local limit=$1
  shift
  python3 - "$limit" "$program" "$@" <<'PYTHON' || fail "$*: too slow or too large"
import os, resource, subprocess, sys
limit, command = float(sys.argv[1]), sys.argv[2:]

def cpu_of(command, said):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = subprocess.call(command, stdout=said, stderr=subprocess.STDOUT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return code, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

def cpu_of_a_second():
    return cpu_of([sys.executable, "second.py"], subprocess.DEVNULL)[1]

for _ in range(3):
    before = cpu_of_a_second()
    with open("said.txt", "w") as said:
        code, used = cpu_of(command, said)
    second = (before + cpu_of_a_second()) / 2
    megabytes = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    print(f"{' '.join(command[1:])}: {used:.2f} s of CPU, {used / second:.2f} s of an idle core of "
          f"3 GHz, {megabytes:.0f} MB")
    if code != 0 or used < limit * second:
        break
sys.exit(code != 0 or used >= limit * second or megabytes >= 300)
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
