load "style.gp"
set output "query_time.svg"
set terminal svg size 600,560 dynamic font "Helvetica,Arial,sans-serif,14" background rgb "white"
set bmargin screen 0.30
set lmargin screen 0.36
set logscale x
set format x "%.0f"
set xlabel "time of a pair, one thread (ns)" offset 0,0.2
set key at screen 0.5, screen 0.015
sets = "paper500 paper500_cached colliding near_miss"
titles = '"500 in sequence" "500, each repeated" "colliding" "near misses"'
rows = system("cut -d, -f1,2 query_time.csv | grep ',paper500$' | wc -l") + 0
set yrange [rows-0.5:-0.5] 
of(set, x) = strcol("pairs") eq set ? column(x) : NaN
plot 'query_time.csv' every ::0::(rows-1) using (column("ns/pair")):0:ytic(strcol("structure")) with dots linecolor rgb "white" notitle, \
  for [i=1:4] 'query_time.csv' using (of(word(sets, i), "ns/pair")):(int($0)%rows + 0.14*(i-2.5)):(column("lower quartile (ns)")):(column("upper quartile (ns)")) \
    with xerrorbars linestyle i title word(titles, i), \
  'query_time.csv' using (of("paper500", "paper (ns/pair)")):(int($0)%rows) with points pointtype 2 pointsize 1.3 linewidth 2.5 linecolor rgb "#444444" title "the paper"
