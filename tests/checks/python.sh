#!/usr/bin/env bash
# The Python reader gives what the program measured: tables as the CSVs say, and beds whose solid
# fraction, neighbours and forces, counted anew by numpy, are those of the tables. The example of its
# manual draws.
# usage: python.sh GRAINSWEEP
set -euo pipefail
GRAINSWEEP=$(realpath "${1:?usage: python.sh GRAINSWEEP}")
root=$(realpath "$(dirname "$0")/../..")
work=$(mktemp -d "${TMPDIR:-/tmp}/grainsweep-python.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
export GRAINSWEEP PYTHONPATH=$root/runner/python PYTHONDONTWRITEBYTECODE=1 MPLCONFIGDIR=$work
for module in pandas matplotlib; do
  if ! /usr/bin/python3 -c "import $module" 2>/dev/null; then
    printf 'SKIPPED: python3-%s is not installed\n' "$module"
    exit 77
  fi
done

cat >sweep.json <<'JSON'
{ "name": "sweep", "seed": 5, "replicates": 2,
  "base": { "accuracy": "fast", "box": { "length": 4 }, "fill": { "solid_height": 5 },
            "measure": { "exclude_floor": 1, "exclude_surface": 1, "gap_tolerances": [1e-4, 1e-3] } },
  "sweep": [ { "label": "walls", "grid": { "box.width": [3, 4, 5] } },
             { "label": "two sizes", "set": { "box.width": 4, "sizes.small_share": 0.3 } },
             { "label": "lognormal", "set": { "box.width": 4, "sizes.distribution.lognormal.sigma": 0.1 } },
             { "label": "tube", "set": { "tube.diameter": 4 } },
             { "label": "bulk", "set": { "box.width": 4, "box.y": "periodic" } },
             { "label": "pinacoids", "set": { "box.width": 4, "shape": "pinacoid" } },
             { "label": "mixture", "set": { "box.width": 4, "shape": { "mixture": [
               { "share": 0.5, "pinacoid": {} }, { "share": 0.5, "cuboid": { "height": 0.5 } } ] } } } ] }
JSON
"$GRAINSWEEP" run sweep.json --quiet --no-report --out out/quick || [ $? -eq 1 ]

/usr/bin/python3 - <<'PYTHON'
import copy
import csv
import pickle
import numpy
import grainsweep

s = grainsweep.open("out/quick")
for name in s.tables:
    rows = list(csv.DictReader(open(f"out/quick/{name}.csv")))
    table = getattr(s, name)
    assert len(table) == len(rows) and list(table) == list(rows[0]), name
    assert list(s.units(name)) == list(table) == list(table.attrs["meanings"]), name
    for column in table.select_dtypes("number"):
        for read, row in zip(table[column], rows):
            assert row[column] == "" and read != read or float(row[column]) == read, (name, column)
assert set(s.tables) >= {"packings", "groups", "fits", "profiles"} and "groups" in dir(s)
assert s.units("packings")["width"] == "d" and "solid" in s.meanings("groups")["solid_fraction"]

names = "sizes.distribution.table.file"
assert list(grainsweep._table(f"{names},x\n01,1\n1,2\n")[names]) == ["01", "1"]

first, second = list(s._places)[:2]
mixed_up = grainsweep.open("out/quick")
mixed_up.__dict__["_places"] = {**s._places, first: s._places[second]}
try:
    mixed_up.bed(first)
    raise SystemExit("the bed of another packing was read")
except ValueError as error:
    assert f"the bed of {first} stands that of {second}" in str(error)

copied = pickle.loads(pickle.dumps(copy.deepcopy(s)))  # as a pool of processes does
assert copied.packings.equals(s.packings) and copied.tables == s.tables
try:
    s.no_table
    raise SystemExit("a table that is not there was read")
except AttributeError as error:
    assert "has no table no_table, but " in str(error)

def below(height, z, radius):
    """Volume of a sphere below a height."""
    h = numpy.clip(height - z + radius, 0, 2 * radius)
    return numpy.pi * h * h * (radius - h / 3)

for row in s.packings.itertuples():
    bed, z = s.bed(row.job), s.bed(row.job).positions[:, 2]
    assert len(bed.positions) == row.grains and (bed.box["tube"] == (row.label == "tube")), row.label
    inside = (row.slab_bottom <= z) & (z < row.slab_top)
    contacts = bed.contacts
    grains, walls = contacts[contacts["b"] >= 0], contacts[contacts["b"] < 0]
    for tolerance, column in (1e-4, "coordination"), (1e-3, "coordination_at_0.001"):
        near = grains[grains["gap"] < tolerance]
        ends = inside[near["a"]].sum() + inside[near["b"]].sum()
        of_walls = inside[walls[walls["gap"] < tolerance]["a"]].sum()
        with_walls = column.replace("coordination", "coordination_with_walls")
        values = s.packings.loc[row.Index]
        assert abs(ends / inside.sum() - values[column]) < 1e-12, (row.label, column)
        assert abs((ends + of_walls) / inside.sum() - values[with_walls]) < 1e-12, (row.label, column)
    near = grains[grains["gap"] < 1e-4]
    counts = numpy.bincount(near["a"], minlength=len(z)) + numpy.bincount(near["b"], minlength=len(z))
    assert (counts == bed.coordination).all(), row.label
    forces = numpy.bincount(contacts["a"], contacts["force"], len(z))
    forces += numpy.bincount(grains["b"], grains["force"], len(z))
    assert numpy.abs(forces - bed.forces).max() < 1e-9, row.label
    floor = numpy.pi / 4 * row.width**2 if bed.box["tube"] else row.length * row.width
    if bed.orientations is None:
        solid = (below(row.slab_top, z, bed.radii) - below(row.slab_bottom, z, bed.radii)).sum()
        assert abs(solid / floor / (row.slab_top - row.slab_bottom) - row.solid_fraction) < 1e-12, row.label
        normal = contacts[["nx", "ny", "nz"]].to_numpy()
        onward = bed.positions[grains["a"]] + normal[: len(grains)] * (
            bed.radii[grains["a"]] + bed.radii[grains["b"]] + grains["gap"].to_numpy())[:, None]
        apart = onward - bed.positions[grains["b"]]
        for axis, period in enumerate((bed.box["length"], bed.box["width"])):
            if bed.box["periodic"][axis]:
                apart[:, axis] -= period * numpy.round(apart[:, axis] / period)
        assert numpy.abs(apart).max() < 1e-12, row.label
    else:
        assert numpy.allclose(numpy.linalg.norm(bed.orientations, axis=1), 1, atol=1e-12)
        if bed.components is None:
            assert len(bed.vertices) == len(bed.faces) == 8
        else:
            assert [len(faces) for _, faces in bed.meshes] == [8, 6] and set(bed.components) == {0, 1}
        assert set(contacts["kind"]) >= {"point", "area"}
print(f"python: {len(s.packings)} beds counted anew, {len(s.tables)} tables")
PYTHON

# Contacts come without a word of the program that finds them.
/usr/bin/python3 -c 'import grainsweep
s = grainsweep.open("out/quick")
s.bed(s.packings["job"][0]).contacts' 2>told.txt
[ ! -s told.txt ] || { printf 'python: contacts tell %s\n' "$(cat told.txt)" >&2 && exit 1; }

# Torn and damaged lines of journals count for nothing, nor do exceptions after a result; of whole
# lines the later one counts, whatever the clock said, and of two journals the packing finished
# later.
cp -r out/quick torn
/usr/bin/python3 - <<'PYTHON'
import json
import pathlib
import zlib
import grainsweep

journal = pathlib.Path("torn/shards/1-of-1.jsonl")
lines = journal.read_bytes().splitlines()
outcomes = [json.loads(line)["outcome"] for line in lines if b'"outcome":' in line]
line_of = {outcome["job"]: line for line in lines for outcome in outcomes if outcome["job"].encode() in line}

def line(outcome, **other):
    text = json.dumps(outcome | other).encode()
    return b'{"length":%d,"crc32":"%08x","outcome":%s}' % (len(text), zlib.crc32(text), text)

def fails(job):
    try:
        grainsweep.open("torn").bed(job)
    except (KeyError, ValueError):
        return True

first, second, third, fourth, fifth = outcomes[:5]
elsewhere = {"stored_at": 1, "finished_at": 9e9}
more = [line_of[first["job"]][:-300],
        line_of[first["job"]].replace(b'"stored_at":', b'"stored_at":1'),
        line(first, reason="torn")[:-1],
        line(second, exception=True, finished_at=9e9, stored_at=0, stored_bytes=0),
        line(third, **elsewhere), line(third, finished_at=1.0),
        line(fourth, **elsewhere | {"stored_bytes": 0})]
journal.write_bytes(b"\n".join([*lines, *more, b'{"length":9,"crc32":"\xff\x85']))
(journal.parent / "2-of-2.jsonl").write_bytes(
    line(first, stored_at=1, finished_at=1.0) + b"\n" + line(fifth, **elsewhere) + b"\n")
(journal.parent / "2-of-2.beds").write_bytes(journal.with_suffix(".beds").read_bytes())
whole, torn = grainsweep.open("out/quick"), grainsweep.open("torn")
for outcome in first, second, third, *outcomes[5:]:
    job = outcome["job"]
    assert (torn.bed(job).positions == whole.bed(job).positions).all(), job
assert fails(fourth["job"]) and fails(fifth["job"])
PYTHON

# Ids and labels are read as they stand, and empty cells as no number.
mkdir words
cp out/quick/columns.csv words
printf '%s\n' job,label,state_hash,family,grains,width 0012345678901234,None,00e1,10,7,5 \
  23e2135835385298,NA,1234567890123456,11,, >words/packings.csv
/usr/bin/python3 - <<'PYTHON'
import grainsweep

packings = grainsweep.open("words").packings
assert list(packings.job) == ["0012345678901234", "23e2135835385298"]
assert list(packings.label) == ["None", "NA"] and list(packings.family) == ["10", "11"]
assert list(packings.state_hash) == ["00e1", "1234567890123456"]
assert list(packings.isna().sum()) == [0, 0, 0, 0, 1, 1] and packings.grains[0] == 7
PYTHON

# What is no output folder, and ids without a bed, are reported with what to do.
mkdir nothing "of a killed run"
cp -r out/quick/shards "of a killed run"
cp -r out/quick pending
sed -i '2s/.*/0123456789abcdef/' pending/packings.csv
/usr/bin/python3 - <<'PYTHON'
import grainsweep

def told(error, action):
    try:
        action()
    except error as raised:
        return raised.args[0]

def opened(folder):
    return told(FileNotFoundError, lambda: grainsweep.open(folder))

assert opened("nowhere") == "nowhere: there is no such folder"
assert opened("nothing") == "nothing is no output folder of grainsweep: it has no columns.csv"
assert opened("out") == ("out is no output folder of grainsweep: it has no columns.csv; "
                         "such folders in it: out/quick"), opened("out")
assert opened("of a killed run") == ("of a killed run has packings but no tables yet: write them with "
                                     "`grainsweep report 'of a killed run'`")
assert opened("sweep.json") == "sweep.json: there is no such folder"

s = grainsweep.open("pending")
assert told(KeyError, lambda: s.bed("xx")) == (
    "xx: no packing of pending has this id; ids are in column job of packings")
assert told(KeyError, lambda: s.bed("0123456789abcdef")) == (
    "0123456789abcdef: no bed is stored in pending, or its line in a journal is damaged; see its status and "
    "reason in packings, and what `grainsweep status` says of the folder")
PYTHON

sed -n '/^```python/,/^```/{//!p}' "$root/runner/python/README.md" >example.py
(($(grep -c . example.py) <= 15)) || { printf 'the example has more than 15 lines\n' && exit 1; }
MPLBACKEND=Agg /usr/bin/python3 example.py
[ -s means.png ]
