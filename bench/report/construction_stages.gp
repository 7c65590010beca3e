load "style.gp"
set output "construction_stages.svg"
set bmargin screen 0.15
set lmargin screen 0.2
unset key

set format x "%g"
set xrange [0:*]
set xlabel "time of a pose, one thread (us)"
set yrange [*:*] reverse
set offsets 0, 0, 0.6, 0.6
plot 'construction_stages.csv' using (column("median (us)")):0:(column("lower quartile (us)")):(column("upper quartile (us)")):ytic(strcol("stage")) with xerrorbars linestyle 2 pointsize 0.9
