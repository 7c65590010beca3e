load "style.gp"
set output "query_time_kernel.svg"
set style data histogram
set style histogram clustered gap 1
set style fill solid 0.8 border -1
set bmargin screen 0.25
set ylabel "time of a pair, one thread (ns)"
set xlabel "pairs"
set logscale y
set yrange [1:*]
sets = "avx512 avx2 sse2 scalar"
colours = "#0072B2 #56B4E9 #E69F00 #D55E00"
set xtics ("colliding" 0, "near miss" 1, "crowd" 2)
workload(w) = w eq "colliding" ? 0 : w eq "near_miss" ? 1 : 2
at(s) = strcol("instruction set") eq s && strcol("semantics") eq "boundary" && column("threads") == 1
set boxwidth 0.18
set xrange [-0.6:2.6]
plot for [i=1:4] 'query_time_kernel.csv' using (at(word(sets, i)) ? workload(strcol("pairs")) + 0.2*(i-2.5) : NaN):(column("ns/pair")) with boxes linecolor rgb word(colours, i) fillstyle pattern i+2 title word(sets, i)
