# Shared by the stories of this folder: each is called as `bash <story>.sh <program>`, works in a
# folder of its own and fails at the first thing that is not as it should be.
set -Eeuo pipefail
trap 'echo "FAILED: $0, line $LINENO: $BASH_COMMAND" >&2' ERR
program=$(realpath "$1")
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
unset GRAINSWEEP_ISA

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# A test that cannot be made here, or not all of it, says why and counts as skipped.
skip() {
  echo "SKIPPED: $*"
  exit 77
}

# Sets `isas` to the instruction sets that this processor has.
find_isas() {
  local isa said
  said=$("$program" doctor)
  isas=()
  for isa in sse2 avx2 avx512; do
    ! grep -q "^instruction sets.*$isa[,;]" <<<"$said" || isas+=("$isa")
  done
}

# expect_code CODE COMMAND...: runs it, output in out.txt and error.txt.
expect_code() {
  local expected=$1 code=0
  shift
  "$@" >out.txt 2>error.txt </dev/null || code=$?
  [ "$code" -eq "$expected" ] || {
    cat out.txt error.txt >&2
    fail "exit code $code instead of $expected: $*"
  }
}

# expect_text FILE TEXT...: every TEXT stands in FILE.
expect_text() {
  local file=$1
  shift
  local text
  for text in "$@"; do
    grep -qF -- "$text" "$file" || {
      cat "$file" >&2
      fail "no \"$text\" in $file"
    }
  done
}

# A sweep of small beds: `replicates` of them at each of four wall gaps and one periodic.
write_sweep() {
  local file=$1 replicates=$2 solid_height=${3:-4}
  cat >"$file" <<JSON
{ "name": "small", "seed": 3, "replicates": $replicates,
  "base": { "shape": "sphere",
            "box": { "length": 5, "width": 5, "x": "periodic", "y": "walls" },
            "fill": { "solid_height": $solid_height },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 },
            "accuracy": "fast" },
  "sweep": [ { "label": "walls", "grid": { "box.width": [3, 4, 5, 6] } },
             { "label": "bulk", "set": { "box.width": 5, "box.y": "periodic" } } ] }
JSON
}

# A descriptor on which nothing ever arrives: to wait on without a process of its own.
exec {never}<> <(:)

# start PROGRAM OPTION...: in the background, what it says in said.txt; sets `runner`. Without `set -m`
# a script's job ignores SIGINT. Until it has become the program it is this script, and would clear up
# as this script does when a signal ends it.
start() {
  set -m
  "$@" >said.txt 2>&1 </dev/null &
  set +m
  runner=$!
  wait_until [ "/proc/$runner/exe" -ef "$1" ] || true
}

# is_running PROCESS: it has not ended. One that nobody has waited for yet is there all the same, and may
# stay: `read -t` of bash 5.2 sometimes leaves the signal that tells of ended children blocked for good.
is_running() {
  local status
  read -r status 2>/dev/null <"/proc/$1/stat" || return 1
  [[ ${status##*) } != Z* ]] || has_threads "$1"
}
# A process that was killed keeps its locks while threads beside its first one end.
has_threads() {
  local tasks=("/proc/$1/task/"*)
  ((${#tasks[@]} > 1))
}

# wait_until CONDITION...: looks every 2 ms; false if the runner ended before the condition held.
wait_until() {
  until "$@"; do
    is_running "$runner" || return 1
    read -rt 0.002 -u "$never" || true
  done
}

# end_runner SIGNAL: sends it, and sets `code` to how the runner ended.
end_runner() {
  code=0
  kill -"$1" "$runner" 2>/dev/null || true
  wait "$runner" 2>/dev/null || code=$?
}

# time_of FIELD PROCESS: nanoseconds that its threads ran (run) or waited for a core (queue), in `time`.
time_of() {
  local task run queue rest
  time=0
  for task in /proc/"$2"/task/*/schedstat; do
    { read -r run queue rest <"$task"; } 2>/dev/null || continue
    time=$((time + $1))
  done
}

# end_in_time SIGNAL: end_runner, and it takes less than 2 s, but for waiting while other processes
# have the cores.
end_in_time() {
  local began queued_before queued shell_before time
  began=$(date +%s%N)
  time_of queue $$
  shell_before=$time
  time_of queue "$runner"
  queued_before=$time queued=$time
  kill -"$1" "$runner" 2>/dev/null || true
  while is_running "$runner"; do
    time_of queue "$runner"
    ((time <= queued)) || queued=$time
    read -rt 0.002 -u "$never" || true
  done
  end_runner "$1"
  time_of queue $$
  local took=$((($(date +%s%N) - began - (queued - queued_before) - (time - shell_before)) / 1000000))
  [ "$took" -lt 2000 ] || fail "$1 took $took ms"
}

# packing_lines FOLDER: the lines of its journals that hold a packing.
packing_lines() {
  grep -hs '"outcome":' "$1"/shards/*.jsonl || true
}

# has_packings FOLDER COUNT: so many of them, or more, are there.
has_packings() {
  local journal text line lines=0
  for journal in "$1"/shards/*.jsonl; do
    [ -e "$journal" ] || continue
    mapfile -t text <"$journal"
    for line in "${text[@]}"; do [[ $line != *'"outcome":'* ]] || lines=$((lines + 1)); done
  done
  [ "$lines" -ge "$2" ]
}

# number_in LINE NAME: the whole number of a member.
number_in() {
  sed 's/.*"'"$2"'":\([0-9]*\).*/\1/' <<<"$1"
}

# beds_in FOLDER: a line for each packing with a bed: its id, and the bed's size and checksums. Lines
# of the journal that are not whole by their own checksum count for nothing, as they do for a run.
beds_in() {
  perl -MCompress::Zlib=crc32 -e 'my (%finished, %bed);
    opendir(my $names, "$ARGV[0]/shards") or die $ARGV[0];
    for my $name (map { /(.*)[.]jsonl$/ ? "$ARGV[0]/shards/$1" : () } readdir($names)) {
      my ($journal, $beds) = ("$name.jsonl", "$name.beds");
      open(my $lines, "<", $journal) or die $journal;
      for (<$lines>) {
        next unless /^\{"length":\d+,"crc32":"([0-9a-f]{8})","outcome":(.*)\}$/ && crc32($2) == hex($1);
        next unless /"job":"([^"]*)".*"finished_at":([^,]*),"stored_at":(\d+),"stored_bytes":([1-9]\d*)/;
        next if exists $bed{$1} && $finished{$1} > $2;
        $finished{$1} = $2;
        open(my $file, "<:raw", $beds) or die $beds;
        seek($file, $3, 0);
        my $got = read($file, my $bytes, $4);
        $bed{$1} = "$got " . unpack("%32C*", $bytes) . " " . unpack("H*", substr($bytes, -4));
      }
    }
    print "$_ $bed{$_}\n" for sort keys %bed' "$1"
}

# damage_bed FOLDER LINE PLACE: another byte at that place of the bed of a journal line.
damage_bed() {
  local at=$(($(number_in "$2" stored_at) + $3))
  printf '\xff' | dd of="$1/shards/1-of-1.beds" bs=1 seek="$at" conv=notrunc status=none
}

# packings.csv without the column cpu_seconds (no cell before it holds a comma).
values_of() {
  local before
  before=$(sed -n '1s/cpu_seconds.*//p' "$1/packings.csv" | tr -cd , | wc -c)
  cut -d, -f"$((before + 1))" --complement "$1/packings.csv"
}
