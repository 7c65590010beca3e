load "style.gp"
set output "depth_time.svg"
set bmargin screen 0.34
set xlabel "maximum recursion depth"
set ylabel "time of a pair, one thread (ns)"
set xrange [-0.5:12.5]
set xtics 1
set logscale y
set format y "%.0f"
at(s, x) = strcol("structure") eq s && strcol("depth") ne "all" ? column(x) : NaN
kinds = '"BCH outline in the batch kernel" "OBB outline" "OBB full mesh" "BCH outline"'
names = '"BCH batch kernel" "OBB outline" "OBB full mesh" "BCH traversal"'
plot for [i=1:4] 'depth.csv' using (column("depth")-0.1):(at(word(kinds, i), "colliding (ns/pair)")):(column("colliding (25 %)")):(column("colliding (75 %)")) with yerrorlines linestyle i title word(names, i).", colliding", \
  for [i=1:4] 'depth.csv' using (column("depth")+0.1):(at(word(kinds, i), "near miss (ns/pair)")):(column("near miss (25 %)")):(column("near miss (75 %)")) with yerrorlines linestyle i+4 dashtype 2 title word(names, i).", near miss"
