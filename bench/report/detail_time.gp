load "style.gp"
set output "detail_time.svg"
set bmargin screen 0.30
set xlabel "people per square metre"
set ylabel "time of a frame, all threads (ns per person)"
set xrange [0:6.5]
set yrange [0:*]
set xtics 1
kinds = '"single cylinder" "depth 3" "depth 6" "all depths" "by density" "fixed cylinder 0.25 m"'
plot for [i=1:6] 'detail.csv' every 6::(i-1) using (column("people per m2")):(column("tests of a frame (ns a person)")):(column("lower quartile (ns)")):(column("upper quartile (ns)")) with yerrorlines linestyle i title word(kinds, i)
