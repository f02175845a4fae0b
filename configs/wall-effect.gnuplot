# The wall effect as a picture, from the tables of a sweep over box.width.
# usage: gnuplot -c configs/wall-effect.gnuplot out/confined-spheres wall-effect.svg
if (ARGC < 2) { print "usage: gnuplot -c wall-effect.gnuplot FOLDER PICTURE.svg"; exit status 2 }
groups = sprintf("< cut -d, -f1-21 '%s/groups.csv'", ARG1)
fit(quantity, column) = real(system(sprintf("grep ',%s,determined,' '%s/fits.csv' | head -n 1 | cut -d, -f%d", quantity, ARG1, column)))
phi_bulk = fit("solid_fraction", 8);  c_phi = fit("solid_fraction", 10)
z_bulk = fit("coordination", 8);      c_z = fit("coordination", 10)

set terminal svg size 900,360 font "sans-serif,14" background "white"
set output ARG2
set datafile separator ","
set encoding utf8
set multiplot layout 1,2
set xlabel "d / W"
set xrange [-0.01:0.28]
set key top right samplen 2 spacing 1.2
set style line 1 lc rgb "#1f5a92" lw 2 pt 7 ps 0.8
set style line 2 lc rgb "#c0392b" lw 2 pt 5 ps 0.8

set ylabel "solid fraction φ"
plot phi_bulk - c_phi * x ls 1 lw 1.5 title sprintf("%.4f - %.3f d / W", phi_bulk, c_phi), \
     groups every ::1 using (strcol(9) eq "walls" ? 1.0 / $7 : NaN):16:17 with yerrorbars ls 1 title "between walls", \
     groups every ::1 using (strcol(9) eq "periodic" ? 0.0 : NaN):16:17 with yerrorbars ls 2 title "no walls"

set ylabel "coordination number Z"
plot z_bulk - c_z * x ls 1 lw 1.5 title sprintf("%.3f - %.2f d / W", z_bulk, c_z), \
     groups every ::1 using (strcol(9) eq "walls" ? 1.0 / $7 : NaN):19:20 with yerrorbars ls 1 title "between walls", \
     groups every ::1 using (strcol(9) eq "periodic" ? 0.0 : NaN):19:20 with yerrorbars ls 2 title "no walls"
unset multiplot
