load "style.gp"
set output "stability_error.svg"
set logscale xy
# A logarithm has no place for zero: it stands at the left edge.
set xrange [0.05:2e9]
set xtics 1,100
unset mxtics
set xtics add ("0" 0.1)
set format x "10^{%T}"
set format y "10^{%T}"
set xlabel "distance from the origin (m)"
set ylabel "largest error (µm per metre of reach)"
tests = '"float" "double" "bch"'
names = '"plain float" "plain double" "bch"'
at(name) = strcol("family") eq "offset" ? column(name) : NaN
where(x) = x == 0 ? 0.1 : x
plot for [i=1:3] 'stability.csv' using (where(at("value"))):(at(word(tests, i).": largest error (um/m)")) with linespoints linestyle i pointsize 1 title word(names, i), \
  4 with lines linestyle 8 dashtype 2 title "promised"
