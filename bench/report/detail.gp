load "style.gp"
set output "detail.svg"
set bmargin screen 0.30
set xlabel "people per square metre"
set ylabel "false stops per person and second"
set logscale y
set xrange [0:6.5]
set xtics 1
kinds = '"single cylinder" "depth 3" "depth 6" "all depths" "by density" "fixed cylinder 0.25 m"'
false_stops = "false stops per person and second"
plot for [i=1:6] 'detail.csv' every 6::(i-1) using (column("people per m2")):(column(false_stops) > 0 ? column(false_stops) : NaN) with linespoints linestyle i title word(kinds, i)
