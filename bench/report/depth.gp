load "style.gp"
set output "depth.svg"
set bmargin screen 0.30
set xlabel "maximum recursion depth"
set ylabel "distance of the meshes at detection (cm)"
set xrange [0:12]
set xtics 1
set yrange [0:*]
kernel = "BCH outline in the batch kernel"
at(x) = strcol("structure") eq kernel && strcol("depth") ne "all" ? column(x) : NaN
cases = system("tail -n 1 depth_cases.csv | cut -d, -f1") + 1
shown = cases > 150 ? 150 : cases
plot for [i=0:shown-1] 'depth_cases.csv' every 1::(i*13)::(i*13+12) using 2:3 with lines linewidth 0.5 linecolor rgb "#c6d9e8" notitle, \
  NaN with lines linewidth 1 linecolor rgb "#c6d9e8" title sprintf("a case (%d of %d)", shown, cases), \
  'depth.csv' using (column("depth")):(at("median (cm)")) with lines linewidth 4 linecolor rgb "#000000" title "BCH, median", \
  'depth.csv' using (column("depth")):(at("lower quartile (cm)")) with lines linewidth 1.6 dashtype 2 linecolor rgb "#000000" title "BCH, quartiles", \
  'depth.csv' using (column("depth")):(at("upper quartile (cm)")) with lines linewidth 1.6 dashtype 2 linecolor rgb "#000000" notitle, \
  'depth.csv' using (0):(strcol("depth") eq "0" ? at("median (cm)") : NaN):(12):(0) with vectors nohead linewidth 2.5 dashtype 4 linecolor rgb "#D55E00" title "single cylinder, median", \
  'depth.csv' using (column("depth")):(strcol("structure") eq "OBB outline" && strcol("depth") ne "all" ? column("median (cm)") : NaN) with lines linewidth 3 linecolor rgb "#0072B2" title "OBB outline, median"
