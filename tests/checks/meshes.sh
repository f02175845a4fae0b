#!/usr/bin/env bash
# gmsh fills the void between exported grains and their container with tetrahedra, for each treatment
# of contacts: it refuses surfaces that cross or touch, and what it fills is the container less the
# grains. Spheres with caps take as long as all others and stand alone. GRAINSWEEP_FAULTS=full: thrice
# the grains. usage: meshes.sh GRAINSWEEP caps|others
set -euo pipefail
grainsweep=$(realpath "${1:?usage: meshes.sh GRAINSWEEP caps|others}")
which=${2:?usage: meshes.sh GRAINSWEEP caps|others}
meshes=$(realpath "$(dirname "$0")/meshes.py")
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-meshes.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
if ! command -v gmsh >/dev/null || ! /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  printf 'SKIPPED: gmsh or python3-numpy is not installed\n'
  exit 77
fi

[ "${GRAINSWEEP_FAULTS:-}" = full ] && grains=(200 100) side=5 || grains=(36 20) side=3.5
spheres='{ "label": "spheres", "set": { "fill.grains": '${grains[0]}' } }'
others='{ "label": "cubes", "set": { "shape": "cube", "fill.grains": '${grains[1]}' } },
        { "label": "periodic", "set": { "fill.grains": 20, "box.length": 3, "box.width": 3, "box.x": "periodic" } }'
[ "$which" = caps ] && blocks=$spheres images= || blocks="$spheres, $others" images=--periodic-images
cat >sweep.json <<JSON
{ "name": "sweep", "seed": 5,
  "base": { "accuracy": "fast", "box": { "length": $side, "width": $side, "x": "walls", "y": "walls" },
            "measure": { "exclude_floor": 0.5, "exclude_surface": 0.5 } },
  "sweep": [ $blocks ] }
JSON
"$grainsweep" run sweep.json --quiet --no-report --out out || [ $? -eq 1 ]
for contacts in shrink:0.98 cap:0.2 bridge:0.2; do
  "$grainsweep" export out --format stl --contacts $contacts $images --quiet --to "${contacts%:*}" >/dev/null
done

if [ "$which" = caps ]; then
  /usr/bin/python3 "$meshes" 1 cap/spheres-1-1.stl
else
  /usr/bin/python3 "$meshes" 0.3 {shrink,cap,bridge}/cubes-2-1.stl | tee said.txt
  /usr/bin/python3 "$meshes" 1 {shrink,bridge}/spheres-1-1.stl {shrink,cap,bridge}/periodic-3-1.stl | tee -a said.txt
  # All but a few grains are joined.
  ! grep '^bridge/.*: [0-9][0-9]\+ surfaces' said.txt || { printf 'meshes: many surfaces\n' && exit 1; }
fi
printf 'meshes: voids are filled\n'
