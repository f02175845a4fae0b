# What counts as done is on the disk first, as the traced calls of a run show: a file's bytes before
# it takes the place of the old one and its folder after; the grains of a packing before its journal
# line, and that line before the packing is reported and its checkpoints are removed. Figures, which
# gnuplot draws from the tables and may draw again, are no part of it.
source "$(dirname "$0")/common.sh" "$1"
needs_strace
write_tiny_sweep 3 sweep.json
out=$(pwd -P)/out

# One thread, so that calls stand in the trace in their order; with the paths of descriptors.
code=0
strace -f -y -qq -s 16 -o trace.txt \
  -e trace=mkdir,write,pwrite64,fsync,fdatasync,rename,unlink,exit_group \
  "$program" run sweep.json --threads 1 --out "$out" --checkpoint-seconds 0 >said.txt 2>&1 || code=$?
[ "$code" -le 1 ] || fail "cannot be traced: $(cat said.txt)"

# Prints every breach of the promise, and what was seen of each kind of file.
awk -v out="$out" '
  function folder_of(path) { sub(/\/[^\/]*$/, "", path); return path }
  function complain(text) { print "BREACH line " NR ": " text; breaches = 1 }
  # Files whose bytes, and folders whose names, the disk may not have yet.
  function expect_flushed(when, path) {
    for (path in unflushed) complain(when " before " path " is on the disk")
  }
  { sub(/^[0-9]+ +/, "") }
  / = -1 E/ { next }
  { split($0, quoted, "\""); first = quoted[2]; second = quoted[4] }
  match($0, /^[a-z0-9]+\([0-9]+<[^>]*>/) {
    path = substr($0, RSTART, RLENGTH); sub(/^[^<]*</, "", path); sub(/>$/, "", path)
  }
  /^mkdir\(/ && first ~ "^" out "/" { unflushed[folder_of(first)] = 1 }
  /^p?write(64)?\(/ {
    if (path ~ "^" out "/shards/.*[.]jsonl$") {
      expect_flushed("a journal line is written")
      ++lines
    }
    if (path ~ "^" out "/shards/.*[.]beds$") ++beds
    if (path ~ "^" out "/" && path !~ "/figures/") unflushed[path] = 1
    else if (/^write\([12]</) { expect_flushed("something is told"); ++told }
  }
  /^f(data)?sync\(/ { delete unflushed[path] }
  /^rename\(/ {
    if (first in unflushed) complain(second " is replaced before its bytes are on the disk")
    delete unflushed[first]
    unflushed[folder_of(second)] = 1
    name = second; sub("^" out "/", "", name)
    if (name ~ "/") sub(/\/[0-9a-f]+\./, "/*.", name)
    ++replaced[name]
  }
  /^unlink\(/ && first ~ /\/checkpoints\// { expect_flushed("a checkpoint is removed"); ++removed }
  /^exit_group\(/ { expect_flushed("the program ends"); ++ended }
  END {
    print lines + 0 " journal lines, " beds + 0 " beds, " told + 0 " times told, " removed + 0 " checkpoints removed, " ended + 0 " end"
    for (name in replaced) print replaced[name] " times " name
    exit breaches
  }' trace.txt >found.txt || fail "$(grep BREACH found.txt | head -n 5)"

# Each of these was seen.
expect_text found.txt "5 journal lines, 3 beds" "times checkpoints/*.0" \
  "times packings.csv" "times provenance.json"
! grep -q " 0 times told\|, 0 checkpoints removed\|, 0 end" found.txt || fail "$(cat found.txt)"

# Exported beds, which can be made again, do not each wait for the disk: their index alone does.
strace -f -qq -o trace.txt -e trace=fsync,rename "$program" export "$out" --to beds >said.txt 2>&1 ||
  fail "cannot be exported: $(cat said.txt)"
[ "$(grep -c 'rename(.*[.]csv"' trace.txt)" -eq 4 ] || fail "not three beds and their index: $(cat trace.txt)"
[ "$(grep -c 'fsync(' trace.txt)" -eq 2 ] || fail "more is flushed than the index and its folder"
head -n 1 found.txt
