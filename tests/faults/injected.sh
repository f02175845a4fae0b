# Every write, flush and rename fails once, or is the last thing the program does: a clear message
# with the path or a run that goes on; no half written file; the same bytes from the next run.
source "$(dirname "$0")/common.sh" "$1"
needs_strace
write_tiny_sweep 2 sweep.json
make_reference sweep.json

# With one thread, and a checkpoint after each of its few steps, so that the k-th call is the same
# one in every run.
run_traced() { # FOLDER STRACE-OPTION...
  local folder=$1
  shift
  strace -f -qq -o trace.txt -e trace=write,fsync,rename "$@" \
    "$program" run sweep.json --no-report --threads 1 --out "$folder" --checkpoint-seconds 0 >said.txt 2>&1
}

run_traced counted || [ $? -le 1 ] || fail "cannot be traced: $(cat said.txt)"
same_as_reference counted "traced"
grep -q 'rename.*checkpoints/' trace.txt || fail "no checkpoint was written"
calls_of() { grep -c "$1(" trace.txt; }
cases=()
for call in write fsync rename; do
  count=$(calls_of $call)
  for fault in error=ENOSPC error=EIO error=EINTR signal=KILL; do
    for k in $(seq "$count"); do cases+=("$call $fault $k"); done
  done
done

# All of them, or as many as there is time for, spread evenly from a random start.
wanted=$(times 40 ${#cases[@]})
first=$(between 0 $((${#cases[@]} - 1)))
told=0 ended=0 killed=0
for number in $(seq 0 $((wanted - 1))); do
  at=$(((first + number * ${#cases[@]} / wanted) % ${#cases[@]}))
  read -r call fault k <<<"${cases[$at]}"
  what="$call $k with $fault"
  code=0
  { run_traced out -e "inject=$call:$fault:when=$k" || code=$?; } 2>killed.txt # says "Killed"
  [[ $fault == signal=* ]] || grep -q INJECTED trace.txt || fail "$what: the call was not made"
  case $code in
    0 | 1) # what goes on all the same has lost nothing
      ended=$((ended + 1))
      cmp <(values_of out) <(values_of reference) || fail "$what: survived with other values"
      ;;
    4)
      told=$((told + 1))
      grep -q '^grainsweep: \(out\|standard output\).*: ' said.txt || fail "$what: no path: $(cat said.txt)"
      ;;
    137) killed=$((killed + 1)) ;;
    *) fail "$what: ended with $code: $(cat said.txt)" ;;
  esac
  # What has its final name is whole: the tables end in a line feed, the grains in their checksum.
  for table in out/*.csv out/provenance.json; do
    [ ! -e "$table" ] || [ -z "$(tail -c 1 "$table")" ] || fail "$what: $table is cut"
  done
  ! comm -13 <(beds_in reference) <(beds_in out) | grep . || fail "$what: a bed of other bytes"
  run_to_the_end sweep.json out --threads 1
  same_as_reference out "$what"
  rm -r out
done
# Threads that the system does not give are noticed before any packing begins.
code=0
strace -f -qq -o trace.txt -e trace=clone,clone3 -e inject=clone,clone3:error=EAGAIN \
  "$program" run sweep.json --no-report --threads 4 --out threadless >said.txt 2>&1 || code=$?
[ $code -eq 5 ] || fail "no threads: ended with $code: $(cat said.txt)"
expect_text said.txt "grainsweep: the system gives not even one thread: raise the limits "

# A signal while stored beds are read: the run ends there, though all packings are made.
code=0
cp -r reference looked-at
strace -f -qq -o trace.txt -P looked-at/shards/1-of-1.beds -e trace=openat \
  -e inject=openat:signal=TERM:when=1 \
  "$program" run sweep.json --no-report --threads 1 --out looked-at >said.txt 2>&1 || code=$?
[ $code -eq 143 ] || fail "stopped while beds were read: ended with $code: $(cat said.txt)"
expect_text said.txt "Stopped. $packings of $packings packings are kept in looked-at"

# Where the file system has no locks, a run says so, works on a shard of its own, and keeps out
# nobody; asking for the lock is the one call that fails, each time.
for error in ENOLCK ENOSYS; do
  code=0
  strace -f -qq -o trace.txt -e trace=flock -e inject=flock:error=$error \
    "$program" run sweep.json --no-report --threads 1 --out unlocked >said.txt 2>&1 || code=$?
  [ $code -le 1 ] || fail "flock with $error: ended with $code: $(cat said.txt)"
  expect_text said.txt "warning: unlocked: its file system offers no lock"
  grep -q INJECTED trace.txt || fail "no lock was asked for"
  cmp <(values_of unlocked) <(values_of reference) || fail "flock with $error: other values"
  cmp <(beds_in unlocked) <(beds_in reference) || fail "flock with $error: other grains"
  rm -r unlocked
done

[ $told -gt 0 ] && [ $killed -gt 0 ] || fail "$told faults told, $killed killed: they do not reach the program"
echo "$wanted of ${#cases[@]} faults: $told told and stopped, $ended survived, $killed killed; the same bytes"
