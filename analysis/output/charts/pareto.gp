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
# What the families of the table are, in the words of milling-model.md: which voxels a step looks at, and what a voxel holds.
array Title[9] = ['new voxels only, smoothed at the surface', 'new voxels only, filled in part', 'new voxels only, there or gone', \
                  'all voxels within the burr, smoothed', 'all voxels within the burr, there or gone, in bins (published)', \
                  'new voxels, sorted into bins of angle and height, more from left to right', 'new voxels, smoothed, at 10 kHz (left) and 1 kHz', \
                  'the same at 10 kHz, edge by edge: more positions of an edge from left to right', 'new voxels, smoothed, and the map that the hand feels']
of(i, what) = strcol('family') eq Family[i] ? column(what) : NaN
# Rows of other families are left out, so that lines join what belongs together.
set datafile missing NaN
set logscale xy
set format x '%g'
set format y '%g'
set xrange [0.3 < * < 3 : *]
set offsets 0, graph 0.1, 0, 0
set xlabel 'time of a step (mean), µs'
sizes = system("awk -F, '$1 == \"".Family[1]."\" { print $2 }' '".table."' | paste -sd, | sed 's/ mm//g; s/,/, /g'")
set multiplot layout 1,2 title "What a step costs and what it is worth: 5 mm burr; polishing, tilted, plunging, curved, two layers\n\
Along a line the voxels shrink, from left to right ".sizes." mm" \
    font ',17' margins 0.06,0.985,0.33,0.87 spacing 0.07,0.1
set ylabel 'error of the mean force, mean over the motions, %'
set key at screen 0.5,0.23 center top maxrows 5 Left reverse samplen 2 width 1 font ',14'
plot for [i=1:9] table using 'step_us_mean':(of(i, 'mean_error_percent')) with linespoints \
         lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2 title Title[i], \
     table using 'step_us_mean':(column('is_default') == 1 ? column('mean_error_percent') : NaN) with points \
         pt 6 ps 2.2 lw 2.5 lc rgb black title 'the default (voxels of 0.1 mm)'
set ylabel 'largest ripple of 10 ms steps, %'
unset key
plot for [i=1:9] table using 'step_us_mean':(of(i, 'worst_ripple_percent')) with linespoints \
         lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2, \
     table using 'step_us_mean':(column('is_default') == 1 ? column('worst_ripple_percent') : NaN) with points \
         pt 6 ps 2.2 lw 2.5 lc rgb black
unset multiplot
