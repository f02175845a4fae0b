#!/usr/bin/env bash
# Exported beds can be read by the programs that they are for, and agree there with the tables:
# extended XYZ by ASE, LAMMPS data by lmp, voxels, surfaces and certificates by numpy.
# usage: exports.sh GRAINSWEEP
set -euo pipefail
grainsweep=$(realpath "${1:?usage: exports.sh GRAINSWEEP}")
check=$(realpath "$(dirname "$0")/../../runner/python/check_certificate.py")
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-exports.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
if ! /usr/bin/python3 -c 'import ase, pandas' 2>/dev/null || ! command -v lmp >/dev/null; then
  printf 'SKIPPED: python3-ase or lammps is not installed\n'
  exit 77
fi

cat >sweep.json <<'JSON'
{ "name": "sweep", "seed": 5,
  "base": { "accuracy": "fast", "box": { "length": 4, "width": 3 }, "fill": { "solid_height": 3 },
            "measure": { "exclude_floor": 0.5, "exclude_surface": 0.5 } },
  "sweep": [ { "label": "two sizes", "set": { "sizes.small_share": 0.3 } },
             { "label": "small", "set": { "sizes.small_share": 1, "sizes.size_ratio": 0.7 } },
             { "label": "tube", "set": { "tube.diameter": 4 } },
             { "label": "cylinders", "set": { "shape": "cylinder", "box.y": "periodic", "box.width": 4 } },
             { "label": "prisms", "set": { "shape": { "prism": { "sides": 41 } }, "box.y": "periodic", "box.width": 4 } },
             { "label": "pinacoids", "set": { "shape": "pinacoid", "box.y": "periodic", "box.width": 4 } },
             { "label": "spheres among cubes", "set": { "box.y": "periodic", "box.width": 5, "box.length": 5, "shape": { "mixture": [
               { "share": 0.5, "cube": {} }, { "share": 0.5, "sphere": {} } ] } } },
             { "label": "mixture", "set": { "box.y": "periodic", "box.width": 5, "box.length": 5, "shape": { "mixture": [
               { "share": 0.5, "cube": {} }, { "share": 0.5, "cuboid": { "height": 0.4 } } ] } } } ] }
JSON
"$grainsweep" run sweep.json --quiet --no-report --out out || [ $? -eq 1 ]

# Beds at exact rest are certified without the program; one whose forces do not balance is not.
cat >exact.json <<'JSON'
{ "name": "exact", "seed": 3,
  "base": { "accuracy": "exact", "box": { "length": 5, "width": 4 }, "fill": { "grains": 150 },
            "measure": { "exclude_floor": 0.5, "exclude_surface": 0.5 } },
  "sweep": [ { "label": "walls", "grid": { "box.y": ["walls", "periodic"] } },
             { "label": "two sizes", "set": { "sizes.small_share": 0.3 } },
             { "label": "tube", "grid": { "tube.diameter": [1.7, 4.5] } } ] }
JSON
"$grainsweep" run exact.json --quiet --no-report --out exact
"$grainsweep" export exact --format certificate --to certificates >/dev/null
(($(/usr/bin/python3 "$check" certificates/*.json | grep -c ' holds ') == 5))
sed '/^"wall_forces"/,$s/\(,[0-9]\.[0-9]\)[0-9]*/\1/' certificates/walls-1-1.certificate.json >rounded.json
if cmp --quiet rounded.json certificates/walls-1-1.certificate.json; then
  echo 'no force was rounded' >&2
  exit 1
fi
if /usr/bin/python3 "$check" rounded.json >said.txt; then
  echo 'a certificate holds whose forces do not balance' >&2
  exit 1
fi
grep -q 'DOES NOT HOLD' said.txt
for format in csv xyz lammps; do "$grainsweep" export out --format $format --quiet --to . >/dev/null; done
"$grainsweep" export out --format voxels --voxels 60 --to . >/dev/null
"$grainsweep" export out --format stl --contacts shrink:0.99 --periodic-images --to . >/dev/null

# Shapes that LAMMPS cannot read are left out, and refused before anything is written if there is no
# other.
cat >round.json <<'JSON'
{ "name": "round", "base": { "accuracy": "fast", "box": { "length": 5, "width": 4 }, "fill": { "solid_height": 2 },
            "measure": { "exclude_floor": 0.3, "exclude_surface": 0.3 } },
  "sweep": [ { "label": "cubes", "set": { "shape": "cube" } },
             { "label": "round", "set": { "shape": { "prism": { "sides": 42 } } } } ] }
JSON
"$grainsweep" run round.json --quiet --no-report --out round || [ $? -eq 1 ]
"$grainsweep" export round --format lammps --to partly >said.txt
grep -q '^1 packing left out: packing .*: a grain has 84 corners' said.txt
ls partly | cmp - <(printf '%s\n' cubes-1-1.data index.csv)
job=$(awk -F, '$2 == "round" { print $1 }' round/packings.csv)
if "$grainsweep" export round --format lammps --job "$job" --to refused 2>said.txt; then
  echo 'shapes are written that LAMMPS cannot read' >&2
  exit 1
fi
grep -q 'shape prism: a grain has 84 corners' said.txt
[ ! -e refused ]

for data in *.data; do
  style=$(sed -n '1s/.*atom_style \([^;]*\);.*/\1/p' "$data")
  printf '%s\n' 'units lj' "$(sed -n '1s/.*; \(boundary .*\)/\1/p' "$data")" "atom_style $style" "read_data $data" \
    'variable n equal count(all)' 'variable m equal mass(all)' 'variable z equal xcm(all,z)' \
    'print "read $n $(v_m:%.15g) $(v_z:%.15g)"' >in.lmp
  lmp -in in.lmp -log "${data%.data}.log" >said.txt 2>&1 || { tail -n 5 said.txt && exit 1; }
done

/usr/bin/python3 - <<'PYTHON'
import re
import ase.io
import numpy
import pandas

def table(file):
    return pandas.read_csv(file, float_precision="round_trip")

index = table("index.csv")
assert (index["unit"] == "d").all(), index["unit"]
packings = table("out/packings.csv").set_index("job")
for file, job in zip(index["file"], index["job"]):
    if not file.endswith(".csv"):
        continue
    stem, packing, grains = file[:-4], packings.loc[job], table(file)
    places, mass = grains[["x", "y", "z"]].to_numpy(), 8 * grains["radius"] ** 3
    if "component" in grains:
        other = 0.4 if stem[:3] == "mix" else numpy.pi / 6  # volumes of the components
        mass *= numpy.where(grains["component"] == 2, other, 1.0)

    atoms = ase.io.read(stem + ".xyz")
    assert atoms.info["length_unit"] == "d", stem
    assert len(atoms) == packing["grains"] and set(atoms.symbols) == {"X"}, stem
    assert (atoms.positions == places).all() and (atoms.arrays["id"] == grains["id"]).all(), stem
    assert (atoms.arrays["force"] == grains["force"]).all(), stem
    small = atoms.arrays["size_class"] == 2
    assert (small == (grains["size_class"] == "small")).all() and small.all() == (stem[:5] == "small"), stem
    assert small.any() == (stem[:3] in ("two", "sma")), stem

    read, total, height = re.search(r"^read (\S+) (\S+) (\S+)$", open(stem + ".log").read(), re.M).groups()
    assert int(read) == len(grains), stem
    assert abs(float(total) / mass.sum() - 1) < 1e-12, stem
    assert abs(float(height) - (mass * grains["z"]).sum() / mass.sum()) < 1e-9, stem

    header, voxels = open(stem + ".nrrd", "rb").read().split(b"\n\n", 1)
    fields = dict(line.split(": ") for line in header.decode().splitlines() if ": " in line)
    sizes = [int(size) for size in fields["sizes"].split()]
    spacing = [float(size) for size in fields["spacings"].split()]
    filled = numpy.frombuffer(voxels, numpy.uint8).reshape(sizes[::-1])
    inside = filled < 255  # of a tube
    assert inside.all() == (stem[:4] != "tube"), stem
    solid = inside & (filled > 0)
    edges = numpy.arange(sizes[2] + 1) * spacing[2]
    of_slab = numpy.diff(edges.clip(packing["slab_bottom"], packing["slab_top"]))  # of each layer
    share = (solid.sum(axis=(1, 2)) / inside.sum(axis=(1, 2)) * of_slab).sum() / of_slab.sum()
    assert abs(share - packing["solid_fraction"]) < 1e-3, (stem, share, packing["solid_fraction"])

    # Every solid is closed: each side of a triangle is that of another one, the other way round.
    data = open(stem + ".stl", "rb").read()
    triangles = numpy.frombuffer(data, [("normal", "<f4", 3), ("corners", "<V12", 3), ("id", "<u2")], offset=84)
    assert not data.startswith(b"solid") and len(triangles) == int.from_bytes(data[80:84], "little"), stem
    assert set(triangles["id"]) == {0, *grains["id"]}, stem
    for id in set(triangles["id"]):
        corners = [[corner.tobytes() for corner in t] for t in triangles["corners"][triangles["id"] == id]]
        sides = [(t[i], t[(i + 1) % 3]) for t in corners for i in range(3)]
        assert len(set(sides)) == len(sides) and {(b, a) for a, b in sides} == set(sides), (stem, id)
print("exports: read as they were written")
PYTHON
