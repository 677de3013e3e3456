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
set bmargin 11
set key at screen 0.5,0.14 center top maxrows 3 samplen 2 font ',13'
set offsets graph 0.02, graph 0.12, graph 0.06, graph 0.04
array Family[8] = ['crescent of partial voxels', 'crescent of binary voxels', 'full scan of partial voxels', \
                   'full scan of binary voxels into bins (published)', 'crescent into bins psi x z', 'crescent in a faster loop', \
                   'crescent at 10 kHz with N instants a tooth', 'crescent and engagement map']
array Colour[8] = [blue, sky, red, amber, green, black, pink, grey]
array Point[8] = [7, 6, 5, 4, 9, 13, 11, 3]
error_of(i) = strcol('family') eq Family[i] ? column('mean_error_percent') : NaN
# Rows of other families are left out, so that lines join what belongs together.
set datafile missing NaN
plot for [i=1:8] table using 'step_us_p50':(error_of(i)) with linespoints \
         lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2 title Family[i], \
     for [i=1:8] table using 'step_us_p50':(error_of(i)):'label' with labels \
         left offset 0.8,0.4 font ',11' tc rgb Colour[i] notitle, \
     table using 'step_us_p50':(column('is_default') == 1 ? column('mean_error_percent') : NaN) with points \
         pt 6 ps 2.4 lw 2.5 lc rgb black title 'the default'
