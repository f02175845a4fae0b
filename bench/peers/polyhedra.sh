#!/usr/bin/env bash
# What a step of a bed of pinacoids costs in grainsweep and in YADE. See usage below.
set -euo pipefail

usage() {
  cat <<'TEXT'
usage: bench/peers/polyhedra.sh [GRAINS] [STEPS]

Settles GRAINS pinacoids (600 if not given, at least 200) in a walled box in grainsweep at balanced, hands the bed
to YADE's Polyhedra (Debian package yade) and times STEPS (100) of its steps, all on one core.
Writes what each code said and polyhedra.md to out/peers-polyhedra-GRAINS, and prints polyhedra.md.

A step of YADE is .001 sqrt(d/g), with grains that push back with 1e5 m g / d^3 of overlap and no
friction; one of grainsweep's is .05 to .2. LMGC90, the code of the reference study, is in no
Debian package and is not run.
TEXT
}

[[ ${1:-} != -h && ${1:-} != --help ]] || { usage && exit 0; }
readonly grains=${1:-600} steps=${2:-100}
[[ $# -le 2 && $grains =~ ^[0-9]{3,5}$ && $grains -ge 200 && $steps =~ ^[1-9][0-9]{0,5}$ ]] || { usage >&2 && exit 2; }
here=$(dirname "$(readlink -f "$0")")
root=$(dirname "$(dirname "$here")")
length=$(awk -v n="$grains" 'BEGIN { print n / 100 }')
out=$PWD/out/peers-polyhedra-$grains
core=$(taskset -cp $$ | sed 's/.*[ ,-]//') # the last one that this shell may use
readonly here root length out core width=5 yade_step=.001
export OMP_NUM_THREADS=1

stop() {
  printf 'polyhedra.sh: %s\n' "$@" >&2
  exit 1
}

# word_of NAME FILE: what follows the name in a line of its own.
word_of() {
  awk -v name="$1" '$1 == name { word = $2 } END { print word; exit word == "" }' "$2"
}

# add_row CODE STEP SAID: what the code said, in lines of a name and a word.
add_row() {
  local seconds energy
  seconds=$(word_of seconds_per_step "$3") || stop "no seconds_per_step in $3"
  energy=$(word_of kinetic_energy "$3") || stop "no kinetic_energy in $3"
  printf '| %s | %s | %.3g | %.1e |\n' "$1" "$2" \
    "$(awk -v s="$seconds" 'BEGIN { print 1000 * s }')" "$energy" >>"$out/polyhedra.md"
}

settle_in_grainsweep() {
  cat >"$out/bed.json" <<JSON
{ "name": "bed", "seed": 1, "replicates": 1,
  "base": { "shape": "pinacoid", "sizes": { "spread": 0 }, "accuracy": "balanced",
            "box": { "length": $length, "width": $width, "x": "walls", "y": "walls" },
            "fill": { "grains": $grains } } }
JSON
  rm -rf "$out/bed"
  taskset -c "$core" "$root/run.sh" run "$out/bed.json" --out "$out/bed" --threads 1 \
    >"$out/grainsweep.log" 2>&1 || stop "grainsweep failed; see $out/grainsweep.log"
  "$root/run.sh" export "$out/bed" --format csv >>"$out/grainsweep.log"
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
           NR == 2 { print "seconds_per_step", $column["cpu_seconds"] / $column["steps"]
                     print "steps", $column["steps"]
                     print "seconds", $column["cpu_seconds"]
                     print "kinetic_energy", $column["kinetic_energy"] }' \
    "$out/bed/packings.csv" >"$out/grainsweep.txt"
}

step_in_yade() {
  local bed
  bed=$out/bed/export/$(awk -F, 'NR == 2 { print $1 }' "$out/bed/export/index.csv")
  GRAINS=$bed LENGTH=$length WIDTH=$width STEP=$yade_step STIFFNESS=1e5 STEPS=$steps \
    taskset -c "$core" yade -n -x -j1 "$here/yade_pinacoids.py" >"$out/yade.txt" 2>"$out/yade.log" ||
    stop "YADE failed; see $out/yade.log"
}

mkdir -p "$out"
settle_in_grainsweep
{
  printf '%s pinacoids: grainsweep settles them in %s steps and %.3g CPU s; %s steps of YADE\n' \
    "$grains" "$(word_of steps "$out/grainsweep.txt")" "$(word_of seconds "$out/grainsweep.txt")" \
    "$steps"
  printf 'from there. One core.\n\n| code | step / sqrt(d/g) | CPU ms a step | '
  printf 'kinetic energy / m g d |\n|---|---|---|---|\n'
} >"$out/polyhedra.md"
add_row grainsweep '.05 to .2' "$out/grainsweep.txt"
if command -v yade >/dev/null; then
  step_in_yade
  add_row YADE $yade_step "$out/yade.txt"
else
  printf 'polyhedra.sh: yade is not installed and left out; on Debian: apt-get install yade\n' >&2
fi
cat "$out/polyhedra.md"
