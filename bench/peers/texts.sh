#!/usr/bin/env bash
# The programs and scripts around the comparison with other codes, on beds small enough to check by
# hand. usage: texts.sh SOURCES PROGRAMS   (bench/peers in the sources and in the build)
set -euo pipefail
sources=$(realpath "$1") programs=$(realpath "$2")
source "$sources/../text_test.sh"

expect() { # expect WHAT WANTED FOUND
  [ "$2" = "$3" ] || fail "$1 is \"$3\" instead of \"$2\""
}

# A cubic lattice of 4 x 4 x 10 spheres between walls: phi = pi / 6, Z = 5.5, with walls 6.
awk 'BEGIN { print "x,y,z,radius,note"
  for (i = 0; i < 160; ++i) {
    print i % 4 + .5 "," int(i / 4) % 4 + .5 "," int(i / 16) + .5 ",0.5,a"
  } }' >lattice.csv
"$programs/peers_measure_bed" lattice.csv 4 4 >row.csv
expect "the row of a lattice" "160,0,0,520,520,479,5.5,6" "$(sed -n 2p row.csv | cut -d, -f1-6,8-)"
awk -F, 'NR == 2 { exit !(($7 - atan2(0, -1) / 6) ^ 2 < 1e-24) }' row.csv ||
  fail "phi of a lattice is not pi / 6: $(cat row.csv)"
expect "columns of the header" "$(sed -n 2p row.csv | tr -cd , | wc -c)" \
  "$(sed -n 1p row.csv | tr -cd , | wc -c)"

code=0
"$programs/peers_measure_bed" nothing.csv 4 4 2>error.txt || code=$?
expect "the exit code without a file" 2 $code
grep -q nothing.csv error.txt || fail "the error does not name the file: $(cat error.txt)"
code=0
"$programs/peers_measure_bed" lattice.csv 4 2>error.txt || code=$?
expect "the exit code without a width" 2 $code

"$programs/peers_write_start" 300 1 >start.csv
expect "lines of a start" 301 "$(wc -l <start.csv)"
"$programs/peers_measure_bed" start.csv 3 5 >loose.csv
expect "overlapping pairs of a start" 0 "$(sed -n 2p loose.csv | cut -d, -f4)"
"$programs/peers_write_start" 300 2 | cmp -s - start.csv && fail "two seeds make one start"

printf 'x,y,z,r\n1,2,3,0.5\n4,5,6.5,0.25\n' |
  awk -F, -v length_x=20 -v width=5 -f "$sources/lammps_data.awk" >start.data
expect "the data file" "loose spheres 2 atoms 1 atom types 0 20 xlo xhi 0 5 ylo yhi -1 8.5 zlo zhi \
Atoms 1 1 1 1.909859317102744 1 2 3 2 1 0.5 1.909859317102744 4 5 6.5" \
  "$(tr -s '\n' ' ' <start.data | sed 's/ $//')"

columns=code,setting,status,cpu_seconds,kinetic_energy,contacts,contacts_near,isostatic_contacts
cat >peers.csv <<CSV
$columns,overlap_mean,overlap_max,solid_fraction,coordination
grainsweep,fast,not_settled,0.5,1e-4,90,95,100,1e-5,1e-4,0.6,5.4
Peer,kn 1e4,settled,20,1e-8,106,107,100,1e-3,1e-2,0.61,5.8
CSV
awk -F, -f "$sources/table.awk" peers.csv >peers.md
grep -qF '| grainsweep | fast (not_settled) | 0.5 | 1.0e-05 | 1.0e-04 | 1e-04 | 0.900 | 0.950 |' \
  peers.md || fail "the table lacks its own row: $(cat peers.md)"
grep -qF '| Peer, kn 1e4 | 40.0 |' peers.md || fail "the table lacks the ratio: $(cat peers.md)"

code=0
bash "$sources/run.sh" 20 >/dev/null 2>error.txt || code=$?
expect "the exit code for too few grains" 2 $code
grep -q "at least 300" error.txt || fail "the usage does not say how many grains: $(cat error.txt)"

BUILD=$(dirname "$(dirname "$programs")") bash "$sources/run.sh" --alone 300 >peers.md 2>log.txt ||
  fail "the comparison fails: $(cat log.txt)"
expect "rows of one's own" 3 "$(grep -cE '^\| grainsweep \| (fast|balanced|accurate) \|' peers.md)"
echo "the comparison's programs and scripts work"
