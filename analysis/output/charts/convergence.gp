# Error against the size of voxels, with its slope: convergence.csv.
load ARG0[1:strlen(ARG0)-strlen('convergence.gp')].'style.gp'
set output folder.'/convergence.svg'
table = folder.'/convergence.csv'
set title 'Error of the mean force falls with the size of voxels (five motions, four places of the lattice)'
set xlabel 'edge of a voxel, mm'
set ylabel 'error, %'
set logscale xy
set format y '%g'
set xtics (0.05, 0.08, 0.1, '0.13' 0.8/6, 0.16, 0.2, '0.27' 0.8/3, 0.4)
set xrange [0.043:0.47]
set key top left Left reverse spacing 1.2
# The slope between the ends of each fitted line.
stats table using (log10($1)) name 'X' nooutput
stats table using (log10($4)) name 'P' nooutput
stats table using (log10($5)) name 'B' nooutput
slope(max, min) = (max - min) / (X_max - X_min)
plot table using 1:5 with lines lw 1.5 dt 2 lc rgb red title sprintf('slope %.2f', slope(B_max, B_min)), \
     '' using 1:3 with points pt 5 ps 1.1 lc rgb red title 'binary voxels', \
     '' using 1:4 with lines lw 1.5 dt 2 lc rgb blue title sprintf('slope %.2f', slope(P_max, P_min)), \
     '' using 1:2 with points pt 7 ps 1.1 lc rgb blue title 'soft voxels', \
     '' using 1:($1 == 0.1 ? $2 : NaN) with points pt 6 ps 2 lw 2.5 lc rgb black title 'the default'
