load "style.gp"
set output "stability_missed.svg"
set logscale x
set xrange [0.5:2e9]
set format x "10^{%T}"
set yrange [0:*]
set xlabel "distance from the origin (m)"
set ylabel "contacts missed (%)"
tests = '"float" "double" "bch"'
names = '"plain float" "plain double" "bch"'
at(name) = strcol("family") eq "offset" ? column(name) : NaN
where(x) = x < 1 ? 1 : x
plot for [i=1:3] 'stability.csv' using (where(at("value"))):(at(word(tests, i).": missed (%)")) with linespoints linestyle i pointsize 1 title word(names, i)
