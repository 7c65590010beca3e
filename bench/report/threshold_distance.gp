load "style.gp"
set output "threshold_distance.svg"
set bmargin screen 0.16
unset key
set logscale x
set xtics (0.25, 0.5, 1, 2, 4, 8)
set xrange [0.2:10]
set yrange [0:*]
set xlabel "threshold (cm)"
set ylabel "mean distance at detection (cm)"
plot 'threshold.csv' using (column("threshold (cm)")):(column("distance at detection (cm)")):(column("distance (95 % low)")):(column("distance (95 % high)")) with yerrorlines linestyle 2 pointsize 1
