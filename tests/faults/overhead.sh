# Journal, scheduling, tables and start-up together take less than a hundredth of a run's CPU time.
# How long the thread of a packing waits for the disk depends on the disk: it is only shown.
root=$(realpath "$(dirname "$0")/../..")
source "$(dirname "$0")/common.sh" "$1"

# Five packings of each width: half a minute's work. Start-up and tables take a tenth of a second,
# which is more than a hundredth of what quick machines pack one of each in. It runs by itself, as
# CPU time grows where cores are shared.
sed 's/"replicates": 3/"replicates": 5/' "$root/configs/confined-spheres.json" >sweep.json
TIMEFORMAT='%U %S'
code=0
{ time "$program" run sweep.json --no-report --out out --threads 1 >said.txt 2>&1; } 2>times.txt ||
  code=$?
[ "$code" -le 1 ] || fail "ended with $code: $(cat said.txt)"
waited="not measured"
if command -v strace >/dev/null; then
  strace -f -o flushes.txt -T -e trace=fsync "$program" run "$root/configs/quick.json" --no-report --out traced \
    --threads 1 >/dev/null 2>&1 || true
  waited=$(sed -n 's/.*<\([0-9.]*\)>$/\1/p' flushes.txt | awk '{ sum += $1 } END { print sum " s" }')
fi
awk -v waited="$waited" -F, '
  FILENAME == "times.txt" { split($0, both, " "); process = both[1] + both[2]; next }
  $0 ~ /^job,/ { for (i = 1; i <= NF; ++i) if ($i == "cpu_seconds") column = i; next }
  { packings += $column }
  END {
    share = 100 * (process - packings) / packings
    printf "%.2f s of CPU, %.2f s of it for packings: %.2f %% for all else; waiting for the disk: %s\n",
      process, packings, share, waited
    exit !(packings > 1 && share < 1)
  }' times.txt out/packings.csv || fail "more than a hundredth of the time"
