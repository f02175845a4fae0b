# A sweep of 100,000 packings: plan and status in 2 s, each in 300 MB, whether nothing of it is
# done or all, by 64 shards into one folder, in 200 files at most. Few have the time to make them: the
# journals, of beds as in configs/quick.json, are made from one line, and all have one bed. status reads
# and checks the journals whole and looks whether every bed is there; that takes no room and tells
# nothing of reading them, which --check does.
source "$(dirname "$0")/common.sh" "$1"
command -v python3 >/dev/null || skip "python3 is not installed"
cat >large.json <<'JSON'
{ "name": "large", "replicates": 100,
  "base": { "box": { "length": 12, "width": 12 }, "fill": { "solid_height": 9.95 } },
  "sweep": [ { "random": { "count": 1000, "box.width": { "uniform": [4, 12] } } } ] }
JSON

# measured SECONDS COMMAND...: CPU time and peak memory lie below; shows both.
measured() {
  local limit=$1
  shift
  python3 - "$limit" "$program" "$@" <<'PYTHON' || fail "$*: too slow or too large"
import os, resource, subprocess, sys
limit, command = float(sys.argv[1]), sys.argv[2:]
with open("said.txt", "w") as said:
    code = subprocess.call(command, stdout=said, stderr=subprocess.STDOUT)
use = resource.getrusage(resource.RUSAGE_CHILDREN)
seconds, megabytes = use.ru_utime + use.ru_stime, use.ru_maxrss / 1024
print(f"{' '.join(command[1:])}: {seconds:.2f} s, {megabytes:.0f} MB")
sys.exit(code != 0 or seconds >= limit or megabytes >= 300)
PYTHON
}

measured 2 plan large.json
expect_text said.txt "100000 packings"
measured 2 plan large.json --json
"$program" run large.json --out out --threads 2 >/dev/null 2>&1 &
for _ in $(seq 300); do has_packings out 1 && break || sleep 0.1; done
kill -KILL $! && wait $! 2>/dev/null || true
measured 2 status out
expect_text said.txt "of 100000 packings done"

python3 - out <<'PYTHON'
import json, os, shutil, sys, zlib
folder = sys.argv[1]
journal = folder + "/shards/1-of-1.jsonl"
line = next(line for line in open(journal, "rb") if b'"outcome":' in line)
outcome = line[line.index(b'"outcome":') + len(b'"outcome":'):-2]
job = json.loads(outcome)["job"].encode()
shards = [f"{folder}/shards/{number}-of-64" for number in range(1, 65)]
journals = [open(shard + ".jsonl", "wb") for shard in shards]
for number, other in enumerate(json.load(open(folder + "/provenance.json"))["sweep"]["jobs"]):
    name = other["id"].encode()
    text = outcome.replace(b'"job":"' + job, b'"job":"' + name)
    line = b'{"length":%d,"crc32":"%08x","outcome":%s}\n' % (len(text), zlib.crc32(text), text)
    journals[number % 64].write(line)
for shard in shards:
    shutil.copy(folder + "/shards/1-of-1.beds", shard + ".beds")
os.remove(journal)
os.remove(folder + "/shards/1-of-1.beds")
PYTHON
files=$(find out -type f | wc -l)
[ "$files" -le 200 ] || fail "$files files hold the sweep"
echo "64 journals: $(cat out/shards/*.jsonl | wc -c | awk '{ printf "%d", $1 / 1e6 }') MB; $files files in all"
measured 2 status out
expect_text said.txt "100000 of 100000 packings done"
! grep -q warning said.txt || fail "a bed that is there is told as missing"
