load "style.gp"
set output "volume_paper.svg"
set ylabel "volume as a multiple of the mesh's"
set yrange [0:*]
set style fill solid 0.35 border -1
set boxwidth 0.3
rows = system("grep -c 'cylinder over' volume_paper.csv") + 0
name(i) = system(sprintf("grep 'cylinder over' volume_paper.csv | sed -n %dp | cut -d, -f1", i))
set xrange [-0.6:rows-0.4]
set xtics ()
do for [i=1:rows] { set xtics add (name(i) i-1) }
# Four rows a character: the number of a row is on column 0.
of(quantity, x) = strcol("quantity") eq quantity ? x : NaN
plot 'volume_paper.csv' using (int($0)/4-0.17):(of("cylinder over mesh volume", column("mean"))):(column("standard deviation")) with boxerrorbars linecolor rgb "#D55E00" title "single cylinder", \
  'volume_paper.csv' using (int($0)/4+0.17):(of("BCH over mesh volume", column("mean"))):(column("standard deviation")) with boxerrorbars linecolor rgb "#0072B2" title "BCH, projected triangles", \
  'volume_paper.csv' using (int($0)/4-0.17):(of("cylinder over mesh volume", column("paper (mean)"))) with points pointtype 2 pointsize 1.3 linewidth 2.5 linecolor rgb "#000000" title "paper", \
  'volume_paper.csv' using (int($0)/4+0.17):(of("BCH over mesh volume", column("paper (mean)"))) with points pointtype 2 pointsize 1.3 linewidth 2.5 linecolor rgb "#000000" notitle
