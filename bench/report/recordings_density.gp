load "style.gp"
set output "recordings_density.svg"
set bmargin screen 0.36
set xlabel "people per square metre, from"
set ylabel "neighbours in overlap (%), who were not"
set xrange [-0.2:6.2]
set yrange [0:*]
set xtics 1
kinds = '"fixed cylinder 0.25 m" "fixed cylinder 0.40 m" "single cylinder of the pose" "depth 3" "depth 6" "all depths" "segments" "4 slabs"'
of(kind) = strcol("structure") eq kind && strcol("recording") eq "all of people" ? column("in overlap (% of neighbours)") : NaN
plot for [i=1:words(kinds)] 'recordings_density.csv' using (column("from people per m2")):(of(word(kinds, i))) with linespoints linestyle i title word(kinds, i)
