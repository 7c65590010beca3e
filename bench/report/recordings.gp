load "style.gp"
set output "recordings.svg"
set bmargin screen 0.36
set logscale x
set xrange [5:200]
set xlabel "pair of neighbours, one thread (ns)"
set ylabel "neighbours in overlap (%), who were not"
set yrange [0:*]
set format x "%.0f"
kinds = '"fixed cylinder 0.25 m" "fixed cylinder 0.40 m" "single cylinder of the pose" "depth 3" "depth 6" "all depths" "segments" "4 slabs"'
of(kind) = strcol("structure") eq kind && strcol("made by") eq "people" ? column("in overlap (% of neighbours)") : NaN
plot for [i=1:words(kinds)] 'recordings.csv' using (column("ns/pair")):(of(word(kinds, i))) with points linestyle i title word(kinds, i)
