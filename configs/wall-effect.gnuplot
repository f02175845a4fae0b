# The wall effect as a picture, from the tables of a sweep over box.width.
# usage: gnuplot -c configs/wall-effect.gnuplot out/confined-spheres wall-effect.svg
if (ARGC < 2) { print "usage: gnuplot -c wall-effect.gnuplot FOLDER PICTURE.svg"; exit status 2 }
groups = ARG1 . "/groups.csv"
# A number of the first line that was fitted, by the name of its column.
fit(quantity, name) = real(system(sprintf("awk -F, 'NR==1{for(k=1;k<=NF;++k)at[$k]=k;next} $at[\"quantity\"]==\"%s\"&&$at[\"status\"]==\"determined\"{print $at[\"%s\"];exit}' '%s/fits.csv'", quantity, name, ARG1)))
phi_bulk = fit("solid_fraction", "bulk");  c_phi = fit("solid_fraction", "C")
z_bulk = fit("coordination", "bulk");      c_z = fit("coordination", "C")

set terminal svg size 900,360 font "sans-serif,14" background "white"
set output ARG2
set datafile separator ","
set datafile columnheaders
set encoding utf8
set multiplot layout 1,2
set xlabel "d / W"
set xrange [-0.01:0.28]
set key top right samplen 2 spacing 1.2
set style line 1 lc rgb "#1f5a92" lw 2 pt 7 ps 0.8
set style line 2 lc rgb "#c0392b" lw 2 pt 5 ps 0.8
walls(x) = strcol("boundary_y") eq "walls" ? 1.0 / column("width") : NaN
none(x) = strcol("boundary_y") eq "periodic" ? 0.0 : NaN

set ylabel "solid fraction φ"
plot phi_bulk - c_phi * x ls 1 lw 1.5 title sprintf("%.4f - %.3f d / W", phi_bulk, c_phi), \
     groups using (walls(0)):"solid_fraction":"solid_fraction_sd" with yerrorbars ls 1 title "between walls", \
     groups using (none(0)):"solid_fraction":"solid_fraction_sd" with yerrorbars ls 2 title "no walls"

set ylabel "coordination number Z"
plot z_bulk - c_z * x ls 1 lw 1.5 title sprintf("%.3f - %.2f d / W", z_bulk, c_z), \
     groups using (walls(0)):"coordination":"coordination_sd" with yerrorbars ls 1 title "between walls", \
     groups using (none(0)):"coordination":"coordination_sd" with yerrorbars ls 2 title "no walls"
unset multiplot
