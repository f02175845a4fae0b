# The trade of speed for accuracy in a scene as a picture, from the table of bench_trade.
# usage: gnuplot -c bench/trade.gnuplot trade.csv trade.svg
if (ARGC < 2) { print "usage: gnuplot -c trade.gnuplot TABLE.csv PICTURE.svg"; exit status 2 }
set datafile separator ","
set datafile missing ""
set encoding utf8
set terminal svg size 1100,400 font "sans-serif,14" background "white"
set output ARG2
set style line 1 lc rgb "#8aa4bf" pt 7 ps 0.5
set style line 2 lc rgb "#1f5a92" pt 7 ps 0.7
set style line 3 lc rgb "#c0392b" pt 5 ps 0.9
set style line 4 lc rgb "#c0392b" pt 4 ps 0.9
scene = system(sprintf("awk -F'\"' 'NR > 1 { print $2; exit }' '%s'", ARG1))
kind(unused) = strlen(strcol(3)) > 0 ? ($18 == 1 ? 3 : 4) : ($18 == 1 ? 2 : 1)
set key below horizontal Left reverse maxcols 2 samplen 1 width -4
set multiplot layout 1,2
set logscale x
set xrange [0.15:*]
set xzeroaxis lt 1 lc rgb "#999999"
set xlabel "CPU time of a packing over that of balanced"
set offsets graph 0, graph 0.05, graph 0.1, graph 0.05
do for [quantity = 0:1] {
  at = 9 + 2 * quantity
  set title scene
  set ylabel (quantity == 0 ? "φ" : "Z")." less that of the reference"
  pick(line) = kind(0) == line ? column(at) : NaN
  plot ARG1 every ::1 using 8:(pick(1)):(column(at + 1)) with yerrorbars ls 1 title "a cheaper one is nearer", \
       ARG1 every ::1 using 8:(pick(2)):(column(at + 1)) with yerrorbars ls 2 title "on the front", \
       ARG1 every ::1 using 8:(pick(3)):(column(at + 1)) with yerrorbars ls 3 title "presets on the front", \
       ARG1 every ::1 using 8:(pick(4)):(column(at + 1)) with yerrorbars ls 4 title "presets beside it", \
       ARG1 every ::1 using 8:(pick(3)):3 with labels offset 0,1 tc rgb "#c0392b" notitle, \
       ARG1 every ::1 using 8:(pick(4)):3 with labels offset 0,1 tc rgb "#c0392b" notitle
}
unset multiplot
