# A mixture with hulls of OBJ and STL files, from the sweep file to tables and exports, and packed again
# from what was exported.
source "$(dirname "$0")/common.sh" "$1"
printf 'v 0 0 0\nv 25 0 0\nv 0 25 0\nv 25 25 0\nv 12 12 20\n' >roof.obj
{
  printf 'solid wedge\n'
  for corners in '0 0 0  0 1 0  1 0 0' '0 0 0  0 0 1  0 1 0' '0 0 0  1 0 0  0 0 1' '1 0 0  0 1 0  0 0 1'; do
    read -r -a at <<<"$corners"
    printf 'facet normal 0 0 0\nouter loop\n'
    printf 'vertex %s %s %s\n' "${at[@]}"
    printf 'endloop\nendfacet\n'
  done
  printf 'endsolid wedge\n'
} >wedge.stl
mixture='"shape": { "mixture": [ { "share": 0.4, "hull": { "file": "roof.obj", "size": 25 } },
  { "share": 0.3, "hull": { "file": "wedge.stl", "size": 0.8 } }, { "share": 0.3, "sphere": {} } ] }'
scene='"box": { "length": 5.5, "width": 5.5, "y": "periodic" }, "accuracy": "fast",
  "measure": { "exclude_floor": 1, "exclude_surface": 1 }'
printf '{ "name": "mixed", "seed": 3, "base": { %s, %s, "fill": { "grains": 200 } } }\n' \
  "$mixture" "$scene" >mixed.json
code=0
"$program" run mixed.json --no-report >/dev/null 2>error.txt || code=$?
[ "$code" -le 1 ] || fail "run ended with $code: $(cat error.txt)"

# Three components, their files told, a row for each pair; profiles as of the whole bed.
grep -q 'shape.mixture.1.hull.vertices.*roof.obj' out/mixed/provenance.json || fail "the file is not told"
[ "$(wc -l <out/mixed/components.csv)" -eq 10 ] || fail "other components: $(cat out/mixed/components.csv)"
bins=$(($(wc -l <out/mixed/profiles.csv) - 1))
[ "$(wc -l <out/mixed/component_profiles.csv)" -eq $((9 * bins + 1)) ] || fail "other profiles of components"

expect_code 0 "$program" export out/mixed --format csv
bed=$(echo out/mixed/export/*1.csv)
[ "$(head -n 1 "$bed")" = "id,size_class,x,y,z,radius,force,coordination,qx,qy,qz,qw,component" ] ||
  fail "grains of no component: $(head -n 1 "$bed")"
printf '{ "name": "again", "base": { %s, %s, "fill": { "file": "%s" } } }\n' \
  "$mixture" "$scene" "$bed" >again.json
code=0
"$program" run again.json --no-report >/dev/null 2>error.txt || code=$?
[ "$code" -le 1 ] || fail "a bed that was exported is not packed: $(cat error.txt)"
column() { # FOLDER TABLE NAME
  awk -F, -v name="$3" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i }
    NR > 1 { print $at }' "$1/$2.csv"
}
[ "$(column out/mixed components grains)" = "$(column out/again components grains)" ] || fail "other components"
paste <(column out/mixed components solid_fraction) <(column out/again components solid_fraction) >fractions.txt
awk '!($1 > $2 - .02 && $1 < $2 + .02) { exit 1 }' fractions.txt ||
  fail "the bed has moved: solid fractions $(cat fractions.txt)"

# Without its components it is no start of a mixture.
cut -d, -f1-12 "$bed" >plain.csv
sed -i "s#$bed#plain.csv#" again.json
expect_code 2 "$program" validate again.json
expect_text error.txt "does not say which grain is of which component"
