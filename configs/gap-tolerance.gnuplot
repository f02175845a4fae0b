# The coordination number without walls against the gap below which grains count as touching, from
# the packings of a sweep with a periodic y. usage: gnuplot -c configs/gap-tolerance.gnuplot out/paper-pinacoids gap-tolerance.svg
if (ARGC < 2) { print "usage: gnuplot -c gap-tolerance.gnuplot FOLDER PICTURE.svg"; exit status 2 }
# Columns by name: coordination at the headline gap_tolerance, and every coordination_at_GAP.
points = sprintf("< awk -F, 'NR==1{for(k=1;k<=NF;++k){if($k~/^coordination_at_/){gap[k]=substr($k,17)}if($k==\"coordination\")z=k;if($k==\"gap_tolerance\")g=k;if($k==\"boundary_y\")b=k;if($k==\"status\")s=k}next} $b==\"periodic\"&&$s==\"settled\"{print $g,$z;for(k in gap)print gap[k],$k}' '%s/packings.csv' | sort -g", ARG1)

set terminal svg size 560,360 font "sans-serif,14" background "white"
set output ARG2
set encoding utf8
set logscale x
set format x "10^{%T}"
set xrange [6e-7:1.6e-2]
set yrange [*<7.9:8.8<*]
set xlabel "grains touch below this gap / d"
set ylabel "coordination number"
set key top left
set grid
paper = 8.581; error = 0.068
set object 1 rectangle from graph 0, first paper - error to graph 1, first paper + error fillcolor "#dddddd" fillstyle solid noborder behind
plot paper with lines linecolor "#888888" dashtype 2 title "printed: 8.581 ± .068", \
     points using 1:2 with points pointtype 7 pointsize 0.6 linecolor "#1f77b4" title "no walls, three packings"
