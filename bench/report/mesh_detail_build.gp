load "style.gp"
set output "mesh_detail_build.svg"
set bmargin screen 0.25
set logscale xy
set format "%.0f"
set xrange [500:70000]
set xlabel "triangles"
set ylabel "time to build a pose, one thread (us)"
at(s, x) = strcol("structure") eq s ? column(x) : NaN
plot 'mesh_detail.csv' using (column("triangles")):(at("OBB full mesh", "build (us)")) with points linestyle 1 pointsize 1.2 title "OBB full mesh", \
  'mesh_detail.csv' using (column("triangles")):(at("BCH outline", "build (us)")) with points linestyle 2 pointsize 1.2 title "BCH outline"
