# How the force on the hand follows the feed: response.csv.
load ARG0[1:strlen(ARG0)-strlen('response.gp')].'style.gp'
set terminal svg size 1000,760 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/response.svg'
table = folder.'/response.csv'
set multiplot layout 2,1 title 'Force on the hand beside that on a rigid burr: 5 mm, 10 000 rpm, a slot 1 mm deep' font ',17' margins 0.09,0.98,0.18,0.93 spacing 0,0.06
set logscale x
set xrange [0.28:33]
set xtics (0.3, 0.5, 1, 2, 3, 5, 10, 20, 30)
names = "implicit:0.5 implicit:1.5 implicit:5 implicit:15 sample-estimate-hold:1.5 interpolate:1.5"
colours = "#56b4e9 #0072b2 #009e73 #888888 #cc79a7 #d55e00"
is_of(i) = (strcol('coupling').':'.sprintf('%g', column('stiffness_n_per_mm'))) eq word(names, i)
set ylabel 'gain'
set logscale y
set yrange [0.002:2]
set format x ''
unset key
set datafile missing NaN
plot for [i=1:words(names)] table using (column('hz')):(is_of(i) ? column('gain') : NaN) \
    with linespoints pt 7 ps 0.7 lw 1.5 lc rgb word(colours, i) notitle
unset logscale y
set yrange [-340:20]
set ytics -300,60,0
set format x '%g'
set ylabel 'phase, degrees'
set xlabel 'frequency, Hz'
set key below maxcols 2 samplen 2
# One that has gone on turning, not one that leads.
lag(degrees) = degrees > 20 ? degrees - 360 : degrees
legend(i) = system("echo '".word(names, i)."' | tr : ' '").' N/mm'
plot for [i=1:words(names)] table using (column('hz')):(is_of(i) ? lag(column('phase_deg')) : NaN) \
    with linespoints pt 7 ps 0.7 lw 1.5 lc rgb word(colours, i) title legend(i)
unset multiplot
