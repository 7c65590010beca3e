load "style.gp"
set output "stability_missed.svg"
set logscale x
# A logarithm has no place for zero: it stands at the left edge.
set xrange [0.05:2e9]
set xtics 1,100
unset mxtics
set xtics add ("0" 0.1)
set format x "10^{%T}"
set yrange [0:*]
set xlabel "distance from the origin (m)"
set ylabel "contacts missed (%)"
tests = '"float" "double" "bch"'
names = '"plain float" "plain double" "bch"'
at(name) = strcol("family") eq "offset" ? column(name) : NaN
where(x) = x == 0 ? 0.1 : x
plot for [i=1:3] 'stability.csv' using (where(at("value"))):(at(word(tests, i).": missed (%)")) with linespoints linestyle i pointsize 1 title word(names, i)
