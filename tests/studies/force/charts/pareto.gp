# Speed against accuracy: pareto.csv.
load ARG0[1:strlen(ARG0)-strlen('pareto.gp')].'style.gp'
set terminal svg size 1200,820 dynamic font 'DejaVu Sans,15' background 'white'
set output folder.'/pareto.svg'
table = folder.'/pareto.csv'
set title "What a step costs and what it is worth: 5 mm burr, five motions"
set xlabel 'time of a step (median), µs'
set ylabel 'error of the mean force, mean over five motions, %'
set logscale xy
set format x '%g'
set format y '%g'
set key outside below maxcols 3 samplen 2 width -2
set offsets graph 0.02, graph 0.1, graph 0.04, graph 0.04
family(name) = strcol('family') eq name ? column('mean_error_percent') : NaN
# 'every' cannot pick rows by text: rows of other families are NaN, which gnuplot leaves out.
set datafile missing NaN
names = "'crescent, partial voxels' 'crescent, binary voxels' 'full scan, partial voxels' 'full scan, binary voxels, bins (published)' 'crescent, bins psi x z' 'crescent, faster loop' 'crescent, 10 kHz, instants' 'crescent, engagement map'"
colours = blue.' '.sky.' '.red.' '.amber.' '.green.' '.black.' '.pink.' '.grey
types = '7 6 5 4 9 13 11 3'
plot for [i=1:words(names)] table using 'step_us_p50':(family(word(names, i))) with linespoints \
         lc rgb word(colours, i) pt int(word(types, i)) ps 1.1 lw 1.2 title word(names, i), \
     for [i=1:words(names)] table using 'step_us_p50':(family(word(names, i))):'label' with labels \
         left offset 0.7,0.45 font ',11' tc rgb word(colours, i) notitle, \
     table using 'step_us_p50':(column('is_default') == 1 ? column('mean_error_percent') : NaN) with points \
         pt 6 ps 3 lw 2.5 lc rgb black title 'the default'
