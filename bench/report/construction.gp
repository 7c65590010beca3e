load "style.gp"
set output "construction.svg"
set bmargin screen 0.15
set lmargin screen 0.33
unset key
set logscale x
set format x "%g"
set xlabel "time of a pose, one thread (us)"
set yrange [*:*] reverse
set offsets 0, 0, 0.6, 0.6
plot 'construction.csv' using (column("median (us)")):0:(column("lower quartile (us)")):(column("upper quartile (us)")):ytic(strcol("structure")) with xerrorbars linestyle 2 pointsize 0.9
