# Spheres x,y,z,r as a data file for LAMMPS and LIGGGHTS; needs -F, -v length_x=L -v width=W.
# Columns: number, type, diameter, density, x, y, z. At density 6 / pi a sphere of diameter 1 has
# mass 1.
NR > 1 {
  line[NR - 1] = sprintf("%d 1 %.17g %.17g %s %s %s", NR - 1, 2 * $4, 6 / 3.14159265358979323846,
                         $1, $2, $3)
  top = $3 > top ? $3 : top
}
END {
  printf "loose spheres\n\n%d atoms\n1 atom types\n", NR - 1
  printf "0 %s xlo xhi\n0 %s ylo yhi\n-1 %s zlo zhi\n\nAtoms\n\n", length_x, width, top + 2
  for (i = 1; i < NR; ++i) print line[i]
}
