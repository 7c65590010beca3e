load "style.gp"
set output "volume.svg"
set bmargin screen 0.32
set ylabel "share of the single cylinder's volume"
set yrange [0:1.1]
set xrange [0.4:6.6]
set xtics rotate by -25 left
set xtics ("single cylinder" 1, "BCH, depth 3" 2, "BCH, depth 6" 3, "BCH, depth 9" 4, "BCH, all depths" 5, "outline" 6)
first = system("sed -n 2p volume.csv | cut -d, -f1")
second = system("sed -n 8p volume.csv | cut -d, -f1")
of(c, x) = strcol("character") eq c ? column(x) : NaN
plot 'volume.csv' using (int($0)%6 + 0.9):(of(first, "normalised volume")):(column("standard deviation")) with yerrorbars linestyle 2 pointsize 1 title first, \
  'volume.csv' using (int($0)%6 + 1.1):(of(second, "normalised volume")):(column("standard deviation")) with yerrorbars linestyle 3 pointsize 1.1 title second
