# Errors of Z and phi over step and residual tolerance, from the table of bench_stability_map.
# usage: gnuplot -c bench/stability_map.gnuplot map.csv map.svg
if (ARGC < 2) { print "usage: gnuplot -c stability_map.gnuplot TABLE.csv PICTURE.svg"; exit status 2 }
set terminal svg size 1100,420 font "sans-serif,14" background "white"
set output ARG2
set datafile separator ","
set encoding utf8
rows(want) = sprintf("< awk -F, '$1 == \"map\" && $4 == \"%s\"' '%s'", want, ARG1)
presets = sprintf("< awk -F, '$1 == \"fast\" || $1 == \"balanced\" || $1 == \"accurate\"' '%s'", ARG1)
set multiplot layout 1,2
set logscale xy
set xrange [0.014:2.9]
set yrange [4e-7:3e-1]
set format y "10^{%L}"
set xlabel "step / √(d/g)"
set ylabel "residual tolerance / m g"
set palette defined (0 "#1a9850", 0.5 "#fee08b", 1 "#d73027")
set key below maxrows 1

set title "|error of the coordination number|"
set cbrange [0:0.3]
plot rows("right") using 2:3:(abs($8)) with points pt 7 ps 1.6 palette title "settled", \
     rows("off") using 2:3:(abs($8)) with points pt 9 ps 1.8 palette title "off", \
     rows("not settled") using 2:3 with points pt 2 ps 1 lc rgb "#888888" title "reported as not settled", \
     rows("refused") using 2:3 with points pt 4 ps 1 lc rgb "#333333" title "refused", \
     presets using 2:3 with points pt 6 ps 2.6 lw 2 lc rgb "#1f5a92" title "presets", \
     presets using 2:3:1 with labels left offset 1.2,0.6 tc rgb "#1f5a92" notitle

set title "|error of the solid fraction|"
set cbrange [0:0.01]
plot rows("right") using 2:3:(abs($7)) with points pt 7 ps 1.6 palette title "settled", \
     rows("off") using 2:3:(abs($7)) with points pt 9 ps 1.8 palette title "off", \
     rows("not settled") using 2:3 with points pt 2 ps 1 lc rgb "#888888" title "reported as not settled", \
     rows("refused") using 2:3 with points pt 4 ps 1 lc rgb "#333333" title "refused", \
     presets using 2:3 with points pt 6 ps 2.6 lw 2 lc rgb "#1f5a92" title "presets", \
     presets using 2:3:1 with labels left offset 1.2,0.6 tc rgb "#1f5a92" notitle
unset multiplot
