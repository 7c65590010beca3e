load "style.gp"
set output "threshold_cost.svg"
set bmargin screen 0.28
set logscale xy
set xtics (0.25, 0.5, 1, 2, 4, 8)
set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10)
set xrange [0.2:10]
set xlabel "threshold (cm)"
set ylabel "times the value at 1 cm"
columns = '"nodes a shape" "bytes a shape" "hierarchy (us)" "colliding (ns/pair)" "near miss (ns/pair)"'
names = '"nodes" "bytes" "building" "colliding pair" "near miss"'
do for [i=1:5] {
  stats 'threshold.csv' using (column("threshold (cm)") == 1 ? column(word(columns, i)) : NaN) name sprintf("At%d", i) nooutput
}
array at1[5] = [At1_max, At2_max, At3_max, At4_max, At5_max]
plot for [i=1:5] 'threshold.csv' using (column("threshold (cm)")):(column(word(columns, i))/at1[i]) with linespoints linestyle i pointsize 1 title word(names, i)
