# Error where stable against the share of the range that is stable: pareto_cutting.csv, pareto_wall.csv.
scripts = ARG0[1:strlen(ARG0)-strlen('map_pareto.gp')]
load scripts.'style.gp'
load scripts.'map_style.gp'
eval names(folder.'/pareto_cutting.csv')
set terminal svg size 1500,620 dynamic font 'DejaVu Sans,15' background 'white'
set output folder.'/map_pareto.svg'
set multiplot layout 1,2 title 'How much of the range each coupling holds, and how true its force is there' \
    font ',18' margins 0.06,0.995,0.13,0.86 spacing 0.07,0.1
set logscale y
set format y '%g'
set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
# Labels stand in a column to the right of the range, each joined to its point.
label_x = 107
set xrange [-2:175]
set xtics 0,20,100
set xlabel 'stable share of the range, %' offset screen -0.09,0
unset key
set border 2
set arrow 1 from graph 0, graph 0 to first 100, graph 0 nohead lc rgb '#444444'
# What is stable nowhere has no error and stays outside the axes.
is_drawn(x) = strlen(strcol('rms_error_percent')) > 0 ? x : -1000
error(x) = strlen(strcol('rms_error_percent')) > 0 ? column('rms_error_percent') : 1
label(x) = strlen(strcol('rms_error_percent')) > 0 ? 10**column('label_decades') : 1
# gnuplot tries an expression on the header, too, where a number is none.
number(x) = column('number') >= 1 ? int(column('number')) : 1
pareto(name) = "table = folder.'/".name.".csv'; " \
    . "stats table using (low = column('axis_low_decades'), high = column('axis_high_decades'), 0) nooutput; " \
    . "set yrange [10**low : 10**high]; plot " \
    . "table using (is_drawn(column('stable_percent'))):(error(0)):(label_x - 2 - column('stable_percent')):(label(0) - error(0)) with vectors nohead lw 1 lc rgb '#bbbbbb', " \
    . "table using (is_drawn(column('stable_percent'))):(error(0)):(Point[number(0)]):(Rgb[number(0)]) with points pt variable ps 1.4 lc rgb variable, " \
    . "table using (is_drawn(label_x)):(label(0)):(strcol('method')):(Rgb[number(0)]) with labels left font ',13' tc rgb variable"
set ylabel 'rms error of the force where stable (median), % of its mean'
set title 'cutting'
eval pareto('pareto_cutting')
unset ylabel
set title 'pressing on a wall'
eval pareto('pareto_wall')
unset multiplot
