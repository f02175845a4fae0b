# Shared by the faults of this folder: each is called as `bash <fault>.sh <program>` and works in a
# folder of its own. GRAINSWEEP_FAULTS=full makes many more tries than the few of every day.
source "$(dirname "${BASH_SOURCE[0]}")/../runner/program/common.sh" "$1"

# times FEW MANY: how often to try.
times() {
  if [ "${GRAINSWEEP_FAULTS:-}" = full ]; then echo "$2"; else echo "$1"; fi
}

# draw NAME LOW HIGH: a random whole number in the variable NAME; the same ones after the same
# RANDOM=SEED.
draw() {
  printf -v "$1" %d $(($2 + (RANDOM * 32768 + RANDOM) % ($3 - $2 + 1)))
}

# between LOW HIGH: another one each time, as $(...) is a shell with random numbers of its own.
between() {
  local drawn
  draw drawn "$1" "$2"
  echo "$drawn"
}

# flip_bit FILE AT BIT: flips that bit of the byte there.
flip_bit() {
  local byte
  byte=$(od -An -tu1 -j "$2" -N 1 "$1")
  printf "\\x$(printf %x $((${byte:-0} ^ (1 << $3))))" |
    dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}

# pause MILLISECONDS
pause() {
  local seconds
  printf -v seconds '%d.%03d' $(($1 / 1000)) $(($1 % 1000))
  read -rt "$seconds" -u "$never" || true
}

# has_checkpoint FOLDER: whether a packing was saved on its way.
has_checkpoint() {
  local files=("$1"/checkpoints/*.[01])
  [ -e "${files[0]}" ]
}

# write_small_sweep FILE [POINT]: six beds of 60 to 130 grains, and those of another point of the
# sweep.
write_small_sweep() {
  cat >"$1" <<JSON
{ "name": "small", "seed": 5, "replicates": 2,
  "base": { "box": { "length": 4, "width": 4 }, "fill": { "solid_height": 4 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1 }, "accuracy": "fast" },
  "sweep": [ { "label": "walls", "grid": { "box.width": [3, 4] } },
             { "label": "bulk", "set": { "box.width": 5, "box.y": "periodic" } }${2:+, $2} ] }
JSON
}

# Beds of a few dozen grains that end, not settled, after 24 steps: few calls of the system each.
write_tiny_sweep() { # REPLICATES FILE
  cat >"$2" <<JSON
{ "name": "tiny", "seed": 5, "replicates": $1,
  "base": { "box": { "length": 3, "width": 3 }, "fill": { "solid_height": 4 },
            "measure": { "exclude_floor": 0, "exclude_surface": 1 },
            "accuracy": { "preset": "fast", "max_steps": 24 } } }
JSON
}

# Calls of the system can be traced and made to fail here.
needs_strace() {
  command -v strace >/dev/null || skip "strace is not installed (setup.sh --checks installs it)"
  strace -f -o trace.txt true 2>said.txt || skip "ptrace is forbidden here: $(tail -n 1 said.txt)"
}

# run_to_the_end FILE FOLDER OPTION...: makes the whole sweep, with its output in said.txt.
run_to_the_end() {
  local file=$1 folder=$2 code=0
  shift 2
  "$program" run "$file" --no-report --out "$folder" "$@" >said.txt 2>&1 </dev/null || code=$?
  [ "$code" -le 1 ] || fail "run $file --out $folder ended with $code: $(cat said.txt)"
}

# The undisturbed run that all others must equal; sets `packings`.
make_reference() { # FILE
  run_to_the_end "$1" reference --threads 2
  packings=$(packing_lines reference | wc -l)
}

# same_as_reference FOLDER WHAT: tables and grains are, byte by byte, those of the undisturbed run,
# every packing was stored once, and nothing half written or under way is left.
same_as_reference() {
  local folder=$1 what=$2 table
  cmp <(values_of "$folder") <(values_of reference) || fail "$what: other values"
  for table in reference/*.csv; do
    table=$(basename "$table")
    [ "$table" = packings.csv ] || cmp "reference/$table" "$folder/$table" || fail "$what: other $table"
  done
  cmp <(beds_in reference) <(beds_in "$folder") || fail "$what: other grains"
  [ "$(whole_jobs "$folder" | sort -u | wc -l)" -eq "$packings" ] || fail "$what: a packing is lost"
  [ "$(whole_jobs "$folder" | wc -l)" -eq "$packings" ] || fail "$what: a packing was made twice"
  nothing_is_left "$folder" "$what"
}

# nothing_is_left FOLDER WHAT: nothing that a run needs only on its way is left.
nothing_is_left() {
  [ -z "$(find "$1" -name '*.tmp.*')" ] || fail "$2: half written files are left"
  [ -z "$(find "$1/checkpoints" -type f 2>/dev/null)" ] || fail "$2: checkpoints are left"
}

# The jobs of the whole journal lines of a folder, one a line.
whole_jobs() { # FOLDER
  packing_lines "$1" | grep '}}$' | sed -n 's/.*"job":"\([0-9a-f]*\)".*/\1/p' || true
}
