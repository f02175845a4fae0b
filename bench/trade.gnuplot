# The trade of speed for accuracy as a picture, from the table of bench_trade.
# usage: gnuplot -c bench/trade.gnuplot trade.csv trade.svg
if (ARGC < 2) { print "usage: gnuplot -c trade.gnuplot TABLE.csv PICTURE.svg"; exit status 2 }
set terminal svg size 1200,380 font "sans-serif,14" background "white"
set output ARG2
set datafile separator ","
set encoding utf8
set style line 1 lc rgb "#8aa4bf" pt 7 ps 0.6
set style line 2 lc rgb "#c0392b" pt 5 ps 1.0
set style line 3 lc rgb "#1f5a92" lw 2 pt 7 ps 0.6
is(group) = strcol(2) eq group
other(value) = (is("preset") || is("reference")) ? NaN : value
front = sprintf("< awk -F, 'NR > 1 && $14 == 1' '%s' | sort -t, -g -k3", ARG1)
set multiplot layout 1,3
set logscale x
set xlabel "CPU seconds a packing"
set key off
set xzeroaxis lt 1 lc rgb "#999999"

set ylabel "error of the solid fraction"
plot ARG1 every ::1 using 3:(other($6)) ls 1, \
     ARG1 every ::1 using 3:(is("preset") ? $6 : NaN) ls 2, \
     ARG1 every ::1 using 3:(is("preset") ? $6 : NaN):1 with labels offset 0,1 tc rgb "#c0392b"

set ylabel "error of the coordination number"
plot ARG1 every ::1 using 3:(other($7)) ls 1, \
     ARG1 every ::1 using 3:(is("preset") ? $7 : NaN) ls 2, \
     ARG1 every ::1 using 3:(is("preset") ? $7 : NaN):1 with labels offset 0,1 tc rgb "#c0392b"

set logscale y
set ylabel "|1 - contacts / isostatic|"
set key bottom left
plot ARG1 every ::1 using 3:(other(abs(1 - $8))) ls 1 title "one part changed", \
     front using 3:(abs(1 - $8)) with lines ls 3 title "best for its cost", \
     ARG1 every ::1 using 3:(is("preset") ? abs(1 - $8) : NaN) ls 2 title "presets", \
     ARG1 every ::1 using 3:(is("preset") ? abs(1 - $8) : NaN):1 with labels offset 0,1 tc rgb "#c0392b" notitle
unset multiplot
