# Force and depth against time from a --log-csv file.
#   gnuplot -e "forces='forces.csv'; plot_file='forces.png'" scripts/plot_forces.gp
set datafile separator ','
set terminal pngcairo size 1200,800 font 'DejaVu Sans,13'
set output plot_file
set key autotitle columnhead top left horizontal
set grid lc rgb '#dddddd'
set border 3
set tics nomirror
set multiplot layout 2,1 margins 0.08,0.92,0.09,0.95 spacing 0.05,0.08
set title 'Force on the hand' offset 0,-0.5
set ylabel 'N'
# Okabe-Ito colours: safe for colour-blind readers.
plot forces using 't_s':'force_x_n' with lines lw 1.2 lc rgb '#0072b2' title 'F_x', \
     '' using 't_s':'force_y_n' with lines lw 1.2 lc rgb '#d55e00' title 'F_y', \
     '' using 't_s':'force_z_n' with lines lw 1.2 lc rgb '#009e73' title 'F_z'
set title 'Depth of the burr and bone removed' offset 0,-0.5
set ylabel 'depth, mm'
set y2label 'removed, mm^3'
set y2tics
set xlabel 'time, s'
plot forces using 't_s':'depth_mm' with lines lw 1.5 lc rgb '#000000' title 'depth', \
     '' using 't_s':'removed_mm3' axes x1y2 with lines lw 1.5 lc rgb '#cc79a7' title 'removed (right axis)'
unset multiplot
