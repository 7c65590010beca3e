# One picture of errors against times: `pairs` is "crowd" or "near miss", `error` a column, `fronts` the table of its front.
load "style.gp"
set logscale x
set xlabel pairs." pair, one thread (ns)"
set ylabel error
set yrange [0:*]
set bmargin screen 0.455
set format x "%.0f"
slabs = '"BCH in 2 slabs" "BCH in 3 slabs" "BCH in 4 slabs" "BCH in 8 slabs"'
kinds = '"BCH outline in the batch kernel" "BCH outline with exact leaves" "BCH outline" "BCH projected" "OBB outline" "OBB outline in 2D" "OBB full mesh" "OBB projected"'
names = '"BCH batch kernel" "BCH exact leaves" "BCH pair by pair" "BCH projected" "OBB outline" "OBB outline in 2D" "OBB full mesh" "OBB projected"'
time = pairs." (ns/pair)"
of(kind) = strcol("structure") eq kind ? column(error) : NaN
begins(kind) = strcol("structure")[1:strlen(kind)] eq kind ? column(error) : NaN
plot fronts using (strcol("pairs") eq pairs ? column("ns/pair") : NaN):(column(error)) with fsteps linestyle 8 dashtype 2 title "front", \
  for [i=1:words(kinds)] 'error_time.csv' using (column(time)):(of(word(kinds, i))) with points linestyle i title word(names, i), \
  for [i=1:words(slabs)] 'error_time.csv' using (column(time)):(of(word(slabs, i))) with points linecolor rgb "#D00000" pointtype 7 pointsize 0.9 title i == 1 ? "BCH in slabs: 2, 3, 4, 8" : "", \
  'error_time.csv' using (column(time)):(begins("FCL")) with points linecolor rgb "#777777" pointtype 2 pointsize 0.7 title "FCL", \
  'error_time.csv' using (column(time)):(begins("single")) with points linecolor rgb "#000000" pointtype 1 pointsize 1 linewidth 2 title "single cylinder", \
  'error_time.csv' using (column(time)):(begins("fixed")) with points linecolor rgb "#000000" pointtype 3 pointsize 0.9 title "fixed cylinders"
