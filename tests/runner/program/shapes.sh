# Pinacoids and hulls from the sweep file to tables and exports, and packed again from what was
# exported.
source "$(dirname "$0")/common.sh" "$1"
printf 'v 0 0 0\nv 25 0 0\nv 0 25 0\nv 25 25 0\nv 12 12 20\n' >roof.obj
cat >shapes.json <<'JSON'
{ "name": "shapes", "seed": 3,
  "base": { "box": { "length": 3.8, "width": 3.2, "x": "periodic", "y": "walls" },
            "fill": { "solid_height": 2.5 }, "measure": { "exclude_floor": 1, "exclude_surface": 1 },
            "accuracy": "fast" },
  "sweep": [ { "label": "spheres" },
             { "label": "pinacoids", "grid": { "shape.pinacoid.angle_deg": [60, 52.5] } },
             { "label": "roofs", "set": { "shape": { "hull": { "file": "roof.obj", "size": 25 } } } } ] }
JSON
expect_code 0 "$program" plan shapes.json
expect_text out.txt "4 packings" "pinacoids" "roofs"

code=0
"$program" run shapes.json --no-report --threads 2 >report.txt 2>progress.txt || code=$?
[ "$code" -le 1 ] || fail "run ended with $code: $(cat progress.txt)"
[ "$(cut -d, -f5 out/shapes/packings.csv | sort -u | tr '\n' ' ')" = "hull pinacoid shape sphere " ] ||
  fail "other shapes: $(cut -d, -f5 out/shapes/packings.csv)"
! grep -q ',failed,\|,pending,' out/shapes/packings.csv || fail "$(cat out/shapes/packings.csv)"

# Other tables name every shape, too.
for table in profiles distributions; do
  shapes=$(awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "shape") at = i } NR > 1 { print $at }' \
    out/shapes/$table.csv | sort -u | paste -sd' ')
  [[ $shapes == *pinacoid* && $shapes != " "* ]] || fail "shapes in $table.csv: $shapes"
done

# Shares of contacts and forces add up to one, axes are neither parallel nor anywhere else.
column() { # NAME ROW
  awk -F, -v name="$1" -v row="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i }
    NR == row + 1 { print $at }' out/shapes/packings.csv
}
[ -z "$(column contacts_simple 1)" ] || fail "spheres have kinds of contacts"
for row in 2 3 4; do
  for kind in contacts force; do
    echo "$(column ${kind}_simple $row) + $(column ${kind}_double $row) + $(column ${kind}_triple $row)"
  done
  column nematic_z $row >nematic.txt
  awk '{ exit !($1 > 0 && $1 < 1) }' nematic.txt || fail "nematic order $(cat nematic.txt)"
done >shares.txt
awk '{ if ($1 + $3 + $5 < 1 - 1e-12 || $1 + $3 + $5 > 1 + 1e-12) exit 1 }' shares.txt ||
  fail "shares are not whole: $(cat shares.txt)"

for format in csv xyz vtp; do
  expect_code 0 "$program" export out/shapes --format $format
done
cd out/shapes/export
mapfile -t stems < <(sed -n 's/\.csv,.*//p' index.csv)
sphere=${stems[0]} pinacoid=${stems[1]} roof=${stems[3]}
[ "$(head -n 1 "$sphere.csv")" = "id,size_class,x,y,z,radius,force,coordination" ] || fail "spheres are turned"
[ "$(head -n 1 "$roof.csv")" = "id,size_class,x,y,z,radius,force,coordination,qx,qy,qz,qw" ] || fail "no turns"
grep -q 'orientation:R:4' "$pinacoid.xyz" || fail "no orientation in XYZ"
grains=$(($(wc -l <"$pinacoid.csv") - 1))
grep -q "NumberOfPoints=\"$((8 * grains))\".*NumberOfPolys=\"$((8 * grains))\"" "$pinacoid.vtp" ||
  fail "not eight vertices and faces a pinacoid"
cp "$pinacoid.vtp" "$here/pinacoid.vtp"
job=$(sed -n "s/^$pinacoid\.csv,\([^,]*\),.*/\1/p" index.csv)
cd "$here"

# A format that no bed fits is refused before anything is written.
expect_code 2 "$program" export out/shapes --format certificate --job "$job" --to refused
expect_text error.txt "--format certificate: packing $job, shape pinacoid: only forces of spheres can be unique"
[ ! -e refused ] || fail "a folder was made for nothing"

# What was exported is packed again, and rests about where it did.
cat >again.json <<JSON
{ "name": "again", "base": { "shape": "pinacoid", "accuracy": "fast",
  "box": { "length": 3.8, "width": 3.2 }, "fill": { "file": "out/shapes/export/$pinacoid.csv" },
  "measure": { "exclude_floor": 1, "exclude_surface": 1 } } }
JSON
code=0
"$program" run again.json --no-report >/dev/null 2>error.txt || code=$?
[ "$code" -le 1 ] || fail "a bed that was exported is not packed: $(cat error.txt)"
[ "$(cut -d, -f6 out/again/packings.csv | tail -n 1)" -eq "$grains" ] || fail "other grains"
{ column solid_fraction 2 && cut -d, -f11 out/again/packings.csv | tail -n 1; } >fractions.txt
awk 'NR == 1 { before = $1 } END { exit !($1 > before - .02 && $1 < before + .02) }' fractions.txt ||
  fail "the bed has moved: solid fractions $(cat fractions.txt)"

# Spheres cannot be turned, and what turns must be told how.
sed -i 's/"shape": "pinacoid"/"shape": "sphere"/' again.json
expect_code 2 "$program" validate again.json
expect_text error.txt "spheres have no orientation"

# One thread makes the same bytes, and so does a run that was cut short.
"$program" run shapes.json --no-report --out one --threads 1 >/dev/null 2>&1 || true
values_of out/shapes >two.txt
values_of one | cmp two.txt - || fail "other bits on one thread"
damage_bed one "$(packing_lines one | grep "$(column job 4)")" 50
"$program" run shapes.json --no-report --out one --threads 1 >/dev/null 2>error.txt || true
cmp <(beds_in out/shapes) <(beds_in one) || fail "the bed was made otherwise"

command -v python3 >/dev/null || skip "python3 is not installed: the VTP file was not read"
# The polygons of each grain enclose its volume, seen from outside counter-clockwise.
python3 - "$here/pinacoid.vtp" <<'PYTHON'
import sys
import xml.etree.ElementTree as tree

piece = tree.parse(sys.argv[1]).getroot().find("PolyData/Piece")
def numbers(part, name):
    return [float(word) for word in piece.find(f"{part}/DataArray[@Name='{name}']").text.split()]

coordinates = numbers("Points", "Points")
points = [coordinates[i:i + 3] for i in range(0, len(coordinates), 3)]
corners = [int(corner) for corner in numbers("Polys", "connectivity")]
ends = [int(end) for end in numbers("Polys", "offsets")]
assert len(points) == int(piece.get("NumberOfPoints")), "points"
assert len(ends) == int(piece.get("NumberOfPolys")) and ends[-1] == len(corners), "polygons"
enclosed = [0.0] * (int(max(numbers("CellData", "id"))))
sizes = [0.0] * len(enclosed)
for begin, end, grain, size in zip([0] + ends, ends, numbers("CellData", "id"),
                                   numbers("CellData", "size")):
    face = [points[corner] for corner in corners[begin:end]]
    a = face[0]
    for b, c in zip(face[1:], face[2:]):  # six times the volume under a triangle
        enclosed[int(grain) - 1] += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                                 + a[2] * (b[0] * c[1] - b[1] * c[0])) / 6
    sizes[int(grain) - 1] = size
for volume, size in zip(enclosed, sizes):
    whole = (3 - 3 ** -0.5) / 6 * size ** 3  # of a pinacoid of 60 degrees
    assert abs(volume / whole - 1) < 1e-9, (volume, whole)
PYTHON
echo "pinacoids and hulls are packed, written and packed again"
