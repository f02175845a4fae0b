#!/usr/bin/env bash
# Settles one start in grainsweep, LAMMPS and LIGGGHTS, one after the other on one core, and sets
# cost beside accuracy. See usage below.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: bench/peers/run.sh [--alone] [GRAINS] [SEED]

Makes GRAINS loose random spheres (2000 if not given, at least 300) between walls 5 d apart; SEED
(1) chooses their sizes and places. Settles exactly these in
  grainsweep  at fast, balanced and accurate;
  LAMMPS      lmp, Debian package lammps;
  LIGGGHTS    liggghts, Debian package liggghts.
All run on one core, in turn; every final bed is measured by the same program from its positions.
Writes peers.csv, peers.md and what each code said to out/peers-GRAINS-SEED, and prints peers.md.
A code that is not installed is left out, and with --alone both others. 2000 grains take some minutes.
BUILD, from the environment, is a build of these sources to use as it is; else build/release is made.

The peers model grains as linear springs without friction. A row is named by the stiffness kn
(m g/d), the restitution e of a collision and the mean kinetic energy (m g d) that ends the run:
  kn 1e4 e 0   critically damped, step .002 sqrt(d/g): inelastic, as in grainsweep
  kn 1e4 e .3  step .004: comes to rest soonest of the dampings and steps tried
  kn 1e6 e .3  step .0004: overlaps nearer to those of grainsweep
TEXT
}

stop() {
  printf 'run.sh: %s\n' "$@" >&2
  exit 1
}
say() { printf 'run.sh: %s\n' "$*" >&2; }

[[ ${1:-} != -h && ${1:-} != --help ]] || { usage && exit 0; }
alone=
[[ ${1:-} != --alone ]] || { alone=yes && shift; }
readonly alone grains=${1:-2000} seed=${2:-1}
[[ $# -le 2 && $grains =~ ^[0-9]{3,7}$ && $grains -ge 300 && $seed =~ ^[0-9]{1,9}$ ]] ||
  { usage >&2 && exit 2; }

here=$(dirname "$(readlink -f "$0")")
root=$(dirname "$(dirname "$here")")
length=$(awk -v n="$grains" 'BEGIN { print n / 100 }') # as bench/peers/peer_bed.hpp has it
out=$PWD/out/peers-$grains-$seed
core=$(taskset -cp $$ | sed 's/.*[ ,-]//') # the last one that this shell may use
readonly here root length out core width=5 build=${BUILD:-$root/build/release}
export OMP_NUM_THREADS=1

build_programs() {
  [[ -z ${BUILD:-} ]] || return 0
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

# timed NAME COMMAND...: runs it on the core; its words go to NAME.log, its CPU time to `seconds`.
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
  timed "$name" "$build/runner/grainsweep" run "$out/$name.json" --out "$results" \
    --threads 1 --no-report ||
    status=$?
  ((status <= 1)) || stop "grainsweep failed; see $out/$name.log"
  "$build/runner/grainsweep" export "$results" --format csv >/dev/null
  local table=$results/packings.csv
  add_row grainsweep "$accuracy" "$(cell_of status "$table")" "$(cell_of kinetic_energy "$table")" \
    "$(cell_of contacts "$table")" "$results/export/$(cell_of file "$results/export/index.csv")"
}

# Stiffness, step and damping of the springs.
declare -rA springs=(
  ['kn 1e4 e 0']='1e4 0.002 283'
  ['kn 1e4 e .3']='1e4 0.004 100'
  ['kn 1e6 e .3']='1e6 0.0004 1000'
)

# kinetic_energy_in LOG: what the script printed when the bed had come to rest.
kinetic_energy_in() {
  awk '/^kinetic_energy/ { energy = $2 } END { print energy; exit !energy }' "$1"
}

# csv_of DUMP: its grains, in the order of their numbers.
csv_of() {
  awk '/^ITEM: ATOMS/ { atoms = 1; print "x,y,z,r"; next }
       atoms { print $2 "," $3 "," $4 "," $5 }' "$1"
}

# run_peer CODE PROGRAM SPRINGS ENERGY: the program's script is CODE.in in small letters.
run_peer() {
  local stiffness step damping name energy
  read -r stiffness step damping <<<"${springs[$3]}"
  name=${1,,}-$stiffness-$damping-$4
  timed "$name" "$2" -in "$here/${1,,}.in" -log none -var data "$out/start.data" \
    -var width "$width" -var energy "$4" -var stiffness "$stiffness" -var step "$step" \
    -var damping "$damping" -var out "$out/$name.dump" || stop "$1 failed; see $out/$name.log"
  energy=$(kinetic_energy_in "$out/$name.log") ||
    stop "$1 did not come to rest; see $out/$name.log"
  csv_of "$out/$name.dump" >"$out/$name.csv"
  add_row "$1" "$3 until KE < $4" settled "$energy" overlapping "$out/$name.csv"
}

# run_peers CODE PROGRAM PACKAGE
run_peers() {
  local energy
  if ! command -v "$2" >/dev/null; then
    say "$1 is not installed and left out; on Debian: apt-get install $3"
    return
  fi
  for energy in 1e-3 1e-5 1e-8; do run_peer "$1" "$2" 'kn 1e4 e 0' $energy; done
  run_peer "$1" "$2" 'kn 1e4 e .3' 1e-8
  [[ $1 != LAMMPS ]] || run_peer "$1" "$2" 'kn 1e6 e .3' 1e-5 # the faster of the two is enough
}

run_all() {
  local accuracy
  for accuracy in fast balanced accurate; do run_grainsweep $accuracy; done
  [[ -z $alone ]] || return 0
  run_peers LAMMPS lmp lammps
  run_peers LIGGGHTS liggghts liggghts
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
