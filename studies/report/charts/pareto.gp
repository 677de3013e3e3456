# Speed against accuracy: pareto.csv.
load ARG0[1:strlen(ARG0)-strlen('pareto.gp')].'style.gp'
set terminal svg size 1500,860 dynamic font 'DejaVu Sans,15' background 'white'
set output folder.'/pareto.svg'
table = folder.'/pareto.csv'
array Family[9] = ['crescent of soft voxels', 'crescent of partial voxels', 'crescent of binary voxels', 'full scan of soft voxels', \
                   'full scan of binary voxels into bins (published)', 'crescent into bins psi x z', \
                   'crescent at 1 and 10 kHz', 'crescent at 10 kHz with 5 20 and 60 instants a tooth', \
                   'crescent and engagement map']
array Colour[9] = [blue, blue, sky, red, amber, green, black, pink, grey]
array Point[9] = [7, 2, 6, 5, 4, 9, 13, 11, 3]
of(i, what) = strcol('family') eq Family[i] ? column(what) : NaN
# The last three families are told apart by their legend: their points lie close.
# Rows of other families are left out, so that lines join what belongs together.
set datafile missing NaN
set logscale xy
set format x '%g'
set format y '%g'
set xrange [0.3 < * < 3 : *]
set offsets 0, graph 0.1, 0, 0
set xlabel 'time of a step (mean), µs'
set multiplot layout 1,2 title 'What a step costs and what it is worth: 5 mm burr; polishing, tilted, plunging, curved, two layers' \
    font ',18' margins 0.06,0.985,0.3,0.88 spacing 0.07,0.1
set ylabel 'error of the mean force, mean over the motions, %'
set key at screen 0.5,0.19 center top maxrows 5 Left reverse samplen 2 width 1 font ',14'
plot for [i=1:9] table using 'step_us_mean':(of(i, 'mean_error_percent')) with linespoints \
         lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2 title Family[i], \
     for [i in '1 3 4 5 6'] table using 'step_us_mean':(of(int(i), 'mean_error_percent')):'label' with labels \
         left offset 0.8,0.45 font ',11' tc rgb Colour[int(i)] notitle, \
     table using 'step_us_mean':(of(2, 'mean_error_percent')):'label' with labels \
         right offset -0.8,-0.45 font ',11' tc rgb Colour[2] notitle, \
     table using 'step_us_mean':(column('is_default') == 1 ? column('mean_error_percent') : NaN) with points \
         pt 6 ps 2.2 lw 2.5 lc rgb black title 'the default (voxels of 0.1 mm)'
set ylabel 'largest ripple of 10 ms steps, %'
unset key
plot for [i=1:9] table using 'step_us_mean':(of(i, 'worst_ripple_percent')) with linespoints \
         lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2, \
     for [i=1:6] table using 'step_us_mean':(of(i, 'worst_ripple_percent')):'label' with labels \
         left offset 0.8,0.45 font ',11' tc rgb Colour[i], \
     table using 'step_us_mean':(column('is_default') == 1 ? column('worst_ripple_percent') : NaN) with points \
         pt 6 ps 2.2 lw 2.5 lc rgb black
unset multiplot
