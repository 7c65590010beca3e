# How large a time step may be where depths are springs, and what a depth adds that is not there, by `bch stability --stiff`.
load "style.gp"
set terminal svg size 1320,420 dynamic font "Helvetica,Arial,sans-serif,14" background rgb "white"
set xlabel "depth of the cut"
set xtics ("0" 0, "3" 3, "6" 6, "all" 9)
set xrange [-0.5:9.5]
set datafile missing NaN
measures = '"penetration" "deepest discs" "line of centres"'
scenes = '"two agents" "a row at a wall" "a door"'
place(depth) = depth eq "all" ? 9 : real(depth)
of(kind, measure, column_name) = strcol("kind") eq kind && strcol("measure") eq measure ? column(column_name) : NaN
step(scene, measure) = strcol("scene") eq scene ? 1000 * of("press", measure, "largest_step_s") : NaN
bound(scene) = strcol("scene") eq scene ? 1000 * column("bound_s") : NaN
rest(measure) = strcol("scene") eq "two agents" ? of("press", measure, "jitter_m_s") : NaN

set output "stiff_contact_steps.svg"
set multiplot layout 1,3 title "Stiff contact: the largest stable time step" font ",17" margins 0.06,0.98,0.3,0.82 spacing 0.06
set yrange [0:50]
set key at screen 0.5, screen 0.04 vertical maxrows 1
do for [s=1:3] {
  set title word(scenes, s).", ms"
  plot for [i=1:3] "stiff_contact.csv" using (place(strcol("depth"))):(step(word(scenes, s), word(measures, i))) with linespoints linestyle i pointsize 1 title word(measures, i), \
    "stiff_contact.csv" using (place(strcol("depth"))):(bound(word(scenes, s))) with lines linestyle 8 dashtype 2 title "2 / omega of the springs"
  unset key
}
unset multiplot

set output "stiff_contact_errors.svg"
set key at screen 0.5, screen 0.04 vertical maxrows 1
set multiplot layout 1,3 title "Stiff contact: what a depth adds that is not there" font ",17" margins 0.06,0.98,0.3,0.82 spacing 0.06
set logscale y
set format y "10^{%T}"
set yrange [*:*]
set title "largest depth at the first touch, m"
plot for [i=1:3] "stiff_contact.csv" using (place(strcol("depth"))):(of("bounce", word(measures, i), "largest_onset_m")) with linespoints linestyle i pointsize 1 title word(measures, i)
unset key
set title "energy created by a bounce, part, mean"
plot for [i=1:3] "stiff_contact.csv" using (place(strcol("depth"))):(of("bounce", word(measures, i), "energy")) with linespoints linestyle i pointsize 1
set title "jitter of two agents at rest, m/s"
plot for [i=1:3] "stiff_contact.csv" using (place(strcol("depth"))):(rest(word(measures, i))) with linespoints linestyle i pointsize 1
unset multiplot
