load "style.gp"
set output "mesh_detail.svg"
set bmargin screen 0.32
set logscale xy
set format "%.0f"
set xrange [500:70000]
set xlabel "triangles"
set ylabel "time of a pair, one thread (ns)"
kinds = '"OBB full mesh" "BCH outline" "BCH outline in the batch kernel"'
names = '"OBB full mesh" "BCH pair by pair" "BCH batch kernel"'
at(s, x) = strcol("structure") eq s ? column(x) : NaN
plot for [i=1:3] 'mesh_detail.csv' using (column("triangles")):(at(word(kinds, i), "colliding (ns/pair)")):(column("colliding (25 %)")):(column("colliding (75 %)")) with yerrorbars linestyle i pointsize 1 title word(names, i).", colliding", \
  for [i=1:3] 'mesh_detail.csv' using (column("triangles")):(at(word(kinds, i), "near miss (ns/pair)")):(column("near miss (25 %)")):(column("near miss (75 %)")) with yerrorbars linestyle i+3 pointsize 1 title word(names, i).", near miss"
