load "style.gp"
set output "density.svg"
set bmargin screen 0.15
set lmargin screen 0.43
set terminal svg size 600,560 dynamic font "Helvetica,Arial,sans-serif,14" background rgb "white"
unset key
set xlabel "people per square metre"
set xrange [0:*]
set yrange [*:*] reverse
set offsets 0, graph 0.05, 0.6, 0.6
plot 'density.csv' using (column("densest (people/m2)")):0:(column("95 % low")):(column("95 % high")):ytic(strcol("structure").(strcol("free") eq "places" ? "" : strcol("free") eq "headings" ? ", turning" : ", posing, too")) with xerrorbars linestyle 2 pointsize 1
