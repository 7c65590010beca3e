# What all charts share: size, fonts, colours that the colour-blind can tell apart (M. Okabe, K. Ito, 2008) and that
# differ in lightness, a mark of its own for each.
set terminal svg size 600,470 dynamic font "Helvetica,Arial,sans-serif,14" background rgb "white"
set datafile separator comma
set datafile columnheaders
set encoding utf8
set border 3 linecolor rgb "#444444"
set tics nomirror textcolor rgb "#222222"
set grid linecolor rgb "#dddddd" linewidth 0.6
set key at screen 0.53, screen 0.015 center bottom horizontal reverse Left samplen 1.4 spacing 1.1 font ",12"
set bmargin screen 0.25
set style line 1 linecolor rgb "#000000" linewidth 1.8 pointtype 7 pointsize 0.55
set style line 2 linecolor rgb "#0072B2" linewidth 1.8 pointtype 5 pointsize 0.6
set style line 3 linecolor rgb "#D55E00" linewidth 1.8 pointtype 9 pointsize 0.8
set style line 4 linecolor rgb "#009E73" linewidth 1.8 pointtype 11 pointsize 0.8
set style line 5 linecolor rgb "#CC79A7" linewidth 1.8 pointtype 13 pointsize 0.8
set style line 6 linecolor rgb "#E69F00" linewidth 1.8 pointtype 6 pointsize 0.8
set style line 7 linecolor rgb "#56B4E9" linewidth 1.8 pointtype 4 pointsize 0.8
set style line 8 linecolor rgb "#777777" linewidth 1.8 pointtype 8 pointsize 0.9
