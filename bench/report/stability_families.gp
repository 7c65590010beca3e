# The errors of three tests against what a family of hard cases varies: a picture for each family, by `bch stability`.
load "style.gp"
set terminal svg size 1320,420 dynamic font "Helvetica,Arial,sans-serif,14" background rgb "white"
families = "offset scale ratio ladder_float ladder_double rotation slender contour slabs heights"
titles = '"Far from the origin" "Small and large shapes" "A large and a small shape" "A ladder of gaps, float" "A ladder of gaps, double" "Tiny, odd and large headings" "Slender shapes" "Outlines of few and many corners" "Bodies in slabs" "One on top of the other"'
axes = '"distance of the agents from the origin, metres" "reach of the shapes, metres" "ratio of their reaches" "gap, units in the last place of a float" "gap, units in the last place of a double" "heading, radians" "length by width" "corners" "slabs" "height of the ground, metres"'
tests = "float double bch"
names = '"plain float" "plain double" "bch"'
set datafile missing NaN
lowest = 1e-20
inside(value) = strcol("family") eq family && column("pairs") > 0 ? value : NaN
greater(a, b) = a > b ? a : b
missed(test) = inside(100.0 * column(test."_misses") / column("meeting"))
falsely_hit(test) = inside(100.0 * column(test."_false_positives") / (column("pairs") - column("meeting")))
error(test) = inside(greater(lowest, greater(column(test."_miss_per_reach"), column(test."_gap_per_reach"))))
do for [f=1:words(families)] {
  family = word(families, f)
  set output "stability_".family.".svg"
  set multiplot layout 1,3 title word(titles, f) font ",17" margins 0.05,0.98,0.3,0.82 spacing 0.06
  set xlabel word(axes, f)
  set key at screen 0.5, screen 0.04 vertical maxrows 1
  set format "%g"
  set xtics autofreq
  set ytics autofreq
  where(x) = x
  unset logscale
  set xrange [*:*]
  set yrange [*:*]
  stats "stability.csv" using (inside(column("conditioning"))) nooutput
  set xrange [STATS_min:STATS_max]
  linear = strstrt("ladder_float ladder_double slabs", family) > 0
  if (!linear) {
    set logscale x
    set format x "10^{%T}"
  }
  if (!linear && STATS_min == 0) {
    # A logarithm has no place for zero: it stands at the left edge.
    stats "stability.csv" using (inside(column("conditioning") > 0 ? column("conditioning") : NaN)) nooutput
    zero = STATS_min / 10
    where(x) = x == 0 ? zero : x
    set xrange [zero:STATS_max]
    set xtics add ("0" zero)
  }
  set yrange [0:*]
  set title "missed contacts, % of those that meet"
  plot for [i=1:3] "stability.csv" using (where(column("conditioning"))):(missed(word(tests, i))) with linespoints linestyle i pointsize 1 title word(names, i), \
    NaN with lines linestyle 8 dashtype 2 title "bch's bound, of gaps alone"
  unset key
  set title "false hits, % of those that do not"
  plot for [i=1:3] "stability.csv" using (where(column("conditioning"))):(falsely_hit(word(tests, i))) with linespoints linestyle i pointsize 1
  set title "largest error, metres per metre of reach"
  set logscale y
  set format y "10^{%T}"
  set yrange [lowest:*]
  set ytics add ("0" lowest)
  plot for [i=1:3] "stability.csv" using (where(column("conditioning"))):(error(word(tests, i))) with linespoints linestyle i pointsize 1, \
    4e-6 with lines linestyle 8 dashtype 2
  unset multiplot
  set key
}
