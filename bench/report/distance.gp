load "style.gp"
set output "distance.svg"
set bmargin screen 0.27
unset key
set style fill solid 0.25 border -1
set style boxplot fraction 0.9 nooutliers
set style data boxplot
set boxwidth 0.45
set ylabel "distance of the meshes at detection (cm)"
set yrange [0:*]
set xrange [0.4:7.6]
set xtics rotate by -25 left nomirror
kinds = '"single cylinder" "BCH outline" "BCH outline by centre" "BCH projected" "OBB outline" "OBB projected" "OBB full mesh"'
set xtics ("single cylinder" 1, "BCH outline" 2, "BCH by centre" 3, "BCH projected" 4, "OBB outline" 5, "OBB projected" 6, "OBB full mesh" 7)
of(kind, table) = strcol("structure") eq kind ? column(table) : NaN
plot for [i=1:7] 'distance_cases.csv' using (i):(of(word(kinds, i), "distance (cm)")) linecolor rgb "#0072B2", \
  'distance.csv' using ($0+1):(column("mean (cm)")) with points pointtype 13 pointsize 1.1 linecolor rgb "#000000", \
  'distance.csv' using ($0+1):(column("paper (cm)")) with points pointtype 2 pointsize 1.3 linewidth 2.5 linecolor rgb "#D55E00"
