# What an arm's encoder steps do to the force on the hand, tooth scene: encoder.csv.
load ARG0[1:strlen(ARG0)-strlen('encoder.gp')].'style.gp'
set terminal svg size 1000,480 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/encoder.svg'
table = folder.'/encoder.csv'
set multiplot layout 1,2 title 'The tooth scene with finer and coarser encoders' font ',17'
set logscale x
set xrange [0.0013:0.14]
set xlabel 'encoder step, mm (leftmost: none)'
set xtics ('0' 0.0015, '0.003' 0.003, '0.006' 0.006, '0.0125' 0.0125, '0.025' 0.025, '0.055' 0.055, '0.1' 0.1)
set yrange [0:*]
unset key
# A logarithmic axis has no zero.
drawn(step) = step > 0 ? step : 0.0015
set ylabel 'force above 5 Hz, rms, % of the mean force'
plot table using (drawn(column('step_mm'))):'noise_percent' with linespoints pt 7 lw 2 lc rgb blue
set ylabel 'jumps of over 0.03 N a second'
plot table using (drawn(column('step_mm'))):'jumps_per_s' with linespoints pt 7 lw 2 lc rgb red
unset multiplot
