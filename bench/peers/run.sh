#!/usr/bin/env bash
# Settles one start in grainsweep, LAMMPS and LIGGGHTS, one after the other on one core, and sets
# cost beside accuracy. See usage below.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: bench/peers/run.sh [GRAINS] [SEED]

Makes GRAINS loose random spheres (2000 if not given, at least 300) between walls 5 d apart, of which
SEED (1) chooses sizes and places, and settles exactly these in
  grainsweep  at fast, balanced and accurate;
  LAMMPS      lmp, Debian package lammps;
  LIGGGHTS    liggghts, Debian package liggghts.
All run on one core, in turn; every final bed is measured by the same program from its positions.
Writes peers.csv, peers.md and what each code said to out/peers-GRAINS-SEED, and prints peers.md.
A code that is not installed is left out. 2000 grains take about five minutes.

The peers model grains as linear springs without friction, kn = 1e4 m g/d, critically damped, until
the mean kinetic energy falls below 1e-3, 1e-5 and 1e-8 m g d; and LAMMPS once more with springs a
hundred times as stiff, step and damping to match, whose overlaps come near to those of grainsweep.
TEXT
}

stop() {
  printf 'run.sh: %s\n' "$@" >&2
  exit 1
}
say() { printf 'run.sh: %s\n' "$*" >&2; }

[[ ${1:-} != -h && ${1:-} != --help ]] || { usage && exit 0; }
readonly grains=${1:-2000} seed=${2:-1}
[[ $# -le 2 && $grains =~ ^[0-9]{3,7}$ && $grains -ge 300 && $seed =~ ^[0-9]{1,9}$ ]] ||
  { usage >&2 && exit 2; }

here=$(dirname "$(readlink -f "$0")")
root=$(dirname "$(dirname "$here")")
length=$(awk -v n="$grains" 'BEGIN { print n / 100 }') # as bench/peers/peer_bed.hpp has it
out=$PWD/out/peers-$grains-$seed
core=$(taskset -cp $$ | sed 's/.*[ ,-]//') # the last one that this shell may use
readonly here root length out core width=5 build=$root/build/release
export OMP_NUM_THREADS=1

build_programs() {
  mkdir -p "$build"
  (
    cd "$root" &&
      { [[ -f $build/build.ninja ]] || cmake --preset release; } &&
      cmake --build --preset release --target grainsweep peers_write_start peers_measure_bed
  ) >"$out/build.log" 2>&1 || {
    tail -n 20 "$out/build.log" >&2
    stop "the build failed; ./setup.sh installs what building takes"
  }
}

# The start for grainsweep (CSV) and for the others (a data file of spheres whose mass is 1 at d).
write_start() {
  "$build/bench/peers/peers_write_start" "$grains" "$seed" >"$out/start.csv"
  awk -F, -v length_x="$length" -v width="$width" -f "$here/lammps_data.awk" \
    "$out/start.csv" >"$out/start.data"
}

# timed NAME COMMAND...: runs it on the core; its words go to NAME.log, its CPU seconds to `seconds`.
timed() {
  local name=$1 status=0 TIMEFORMAT='%U %S'
  shift
  say "$name ..."
  { time taskset -c "$core" "$@" >"$out/$name.log" 2>&1; } 2>"$out/$name.time" || status=$?
  seconds=$(awk '{ print $1 + $2 }' "$out/$name.time")
  return $status
}

# add_row CODE SETTING STATUS KINETIC_ENERGY CONTACTS BED.csv: CONTACTS may be `overlapping`.
add_row() {
  local measures contacts=$5
  measures=$("$build/bench/peers/peers_measure_bed" "$6" "$length" "$width" | tail -n 1)
  [[ $contacts != overlapping ]] || contacts=$(cut -d, -f4 <<<"$measures")
  printf '%s,%s,%s,%s,%s,%s,%s\n' "$1" "$2" "$3" "$seconds" "$4" "$contacts" "$measures" \
    >>"$out/peers.csv"
}

# cell_of COLUMN FILE: the value in the first row below the header.
cell_of() {
  awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i }
                        NR == 2 { print $column }' "$2"
}

run_grainsweep() {
  local accuracy=$1 name=grainsweep-$1 results=$out/grainsweep-$1 status=0
  cat >"$out/$name.json" <<JSON
{ "name": "$name", "seed": 1, "replicates": 1,
  "base": { "shape": "sphere",
            "box": { "length": $length, "width": $width, "x": "periodic", "y": "walls" },
            "fill": { "file": "start.csv" }, "accuracy": "$accuracy" },
  "sweep": [ { "label": "$accuracy" } ] }
JSON
  # Exit code 1 is a bed that missed its tolerances: the row says so.
  timed "$name" "$build/runner/grainsweep" run "$out/$name.json" --out "$results" --threads 1 ||
    status=$?
  ((status <= 1)) || stop "grainsweep failed; see $out/$name.log"
  "$build/runner/grainsweep" export "$results" --format csv >/dev/null
  local table=$results/packings.csv
  add_row grainsweep "$accuracy" "$(cell_of status "$table")" "$(cell_of kinetic_energy "$table")" \
    "$(cell_of contacts "$table")" "$results/export/$(cell_of job "$table").csv"
}

# run_peer CODE PROGRAM SCRIPT ENERGY [STIFFNESS STEP DAMPING]
run_peer() {
  local name=$1-$4-${5:-1e4} dump=$out/$1-$4-${5:-1e4}.dump energy
  timed "$name" "$2" -in "$here/$3" -log none -var data "$out/start.data" -var out "$dump" \
    -var width "$width" -var energy "$4" -var stiffness "${5:-1e4}" -var step "${6:-0.002}" \
    -var damping "${7:-283}" || stop "$1 failed; see $out/$name.log"
  energy=$(awk '/^kinetic_energy/ { print $2 }' "$out/$name.log")
  awk '/^ITEM: ATOMS/ { atoms = 1; print "x,y,z,r"; next } atoms { print $2 "," $3 "," $4 "," $5 }' \
    "$dump" >"$out/$name.csv"
  add_row "$1" "kn ${5:-1e4} until KE < $4" settled "$energy" overlapping "$out/$name.csv"
}

# has_program PROGRAM PACKAGE CODE
has_program() {
  command -v "$1" >/dev/null && return
  say "$3 is not installed and left out; on Debian: apt-get install $2"
  return 1
}

run_all() {
  local energy accuracy
  for accuracy in fast balanced accurate; do run_grainsweep $accuracy; done
  if has_program lmp lammps LAMMPS; then
    for energy in 1e-3 1e-5 1e-8; do run_peer LAMMPS lmp lammps.in $energy; done
    run_peer LAMMPS lmp lammps.in 1e-5 1e6 0.0002 2830
  fi
  if has_program liggghts liggghts LIGGGHTS; then
    for energy in 1e-3 1e-5 1e-8; do run_peer LIGGGHTS liggghts liggghts.in $energy; done
  fi
}

mkdir -p "$out"
build_programs
write_start
rm -rf "$out"/grainsweep-*
printf 'code,setting,status,cpu_seconds,kinetic_energy,contacts,%s\n' \
  "$("$build/bench/peers/peers_measure_bed" "$out/start.csv" "$length" "$width" | head -n 1)" \
  >"$out/peers.csv"
run_all
awk -F, -f "$here/table.awk" "$out/peers.csv" | tee "$out/peers.md"
