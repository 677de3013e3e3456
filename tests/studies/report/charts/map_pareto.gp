# Error where stable against the share of the range that is stable: pareto_cutting.csv, pareto_wall.csv.
scripts = ARG0[1:strlen(ARG0)-strlen('map_pareto.gp')]
load scripts.'style.gp'
load scripts.'map_style.gp'
eval names(folder.'/pareto_cutting.csv')
set terminal svg size 1500,620 dynamic font 'DejaVu Sans,15' background 'white'
set output folder.'/map_pareto.svg'
set multiplot layout 1,2 title 'How much of the range each coupling holds, and how true its force is there' \
    font ',18' margins 0.06,0.995,0.13,0.86 spacing 0.07,0.1
set format y '%g'
set ytics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
# Labels stand in a column to the right of the range, each joined to its point.
label_x = 107
set xrange [-2:175]
set xtics 0,20,100
set xlabel 'stable share of the range, %' offset screen -0.09,0
unset key
set border 2
set arrow 1 from graph 0, graph 0 to first 100, graph 0 nohead lc rgb '#444444'
is(i, what) = column('number') == i ? column(what) : NaN
is_drawn(i) = column('number') == i && strlen(strcol('rms_error_percent')) > 0
pareto(name) = "table = folder.'/".name.".csv'; " \
    . "unset logscale y; set yrange [*:*]; stats table using (log10(column('rms_error_percent'))) name 'Error' nooutput; stats table using 'label_decades' name 'Label' nooutput; " \
    . "low = Error_min < Label_min ? Error_min : Label_min; high = Error_max > Label_max ? Error_max : Label_max; " \
    . "set logscale y; set yrange [10**(low - 0.1) : 10**(high + 0.1)]; plot " \
    . "for [i=1:11] table using (is_drawn(i) ? column('stable_percent') : NaN):'rms_error_percent':(label_x - 2 - column('stable_percent')):(10**column('label_decades') - column('rms_error_percent')) with vectors nohead lw 1 lc rgb '#bbbbbb', " \
    . "for [i=1:11] table using (is_drawn(i) ? column('stable_percent') : NaN):'rms_error_percent' with points pt Point[i] ps 1.4 lc rgb Colour[i], " \
    . "for [i=1:11] table using (is_drawn(i) ? label_x : NaN):(10**column('label_decades')):(strcol('method')) with labels left font ',13' tc rgb Colour[i]"
set ylabel 'rms error of the force where stable (median), % of its mean'
set title 'cutting'
eval pareto('pareto_cutting')
unset ylabel
set title 'pressing on a wall'
eval pareto('pareto_wall')
unset multiplot
