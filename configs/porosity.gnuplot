# Porosity of tubes filled with spheres against D / d, from the tables of a sweep over tube.diameter.
# usage: gnuplot -c configs/porosity.gnuplot out/tubes porosity.svg
#
# Beside the measured means, with standard errors:
# - the exact single file, D <= (1 + sqrt(3) / 2) d;
# - two fits to poured beds of real spheres, whose friction keeps them looser by 0.03 to 0.04: Dixon,
#   Can. J. Chem. Eng. 66 (1988) 705, for D >= 2 d, and Benyahia and O'Neill, Part. Sci. Technol. 23
#   (2005) 169.
if (ARGC < 2) { print "usage: gnuplot -c porosity.gnuplot FOLDER PICTURE.svg"; exit status 2 }
groups = ARG1 . "/groups.csv"

set terminal svg size 900,420 font "sans-serif,14" background "white"
set output ARG2
set datafile separator ","
set datafile columnheaders
set encoding utf8
set samples 600
set style line 1 lc rgb "#1f5a92" lw 1 pt 7 ps 0.35
set style line 2 lc rgb "#c0392b" lw 1.5
set style line 3 lc rgb "#7a7a7a" lw 1.5 dt 2
set style line 4 lc rgb "#7a7a7a" lw 1.5 dt 4
set xlabel "diameter of the tube, D / d"
set ylabel "porosity, 1 - φ"
set xrange [1:10.1]
set key top right samplen 2 spacing 1.2
widest_file = 1 + sqrt(3) / 2
file(D) = D <= widest_file ? 1 - 2.0 / 3.0 / D**3 / sqrt(2.0 / D - 1) : NaN
dixon(D) = D >= 2 ? 0.4 + 0.05 / D + 0.412 / D**2 : NaN
benyahia(D) = D >= 1.5 ? 0.390 + 1.740 / (D + 1.140)**2 : NaN
tube(x) = strcol("boundary_y") eq "tube" ? column("width") : NaN
plot file(x) ls 2 title "single file, exact", \
     dixon(x) ls 3 title "with friction: Dixon", \
     benyahia(x) ls 4 title "with friction: Benyahia, O'Neill", \
     groups using (tube(0)):(1 - column("solid_fraction") - column("solid_fraction_error")) \
       :(0):(2 * column("solid_fraction_error")) with vectors nohead ls 1 notitle, \
     groups using (tube(0)):(1 - column("solid_fraction")) with points ls 1 \
       title "without friction, measured"
