# Error of the force against resistance, a panel a grip: errors.csv.
scripts = ARG0[1:strlen(ARG0)-strlen('map_errors.gp')]
load scripts.'style.gp'
load scripts.'map_style.gp'
table = folder.'/errors.csv'
eval names(table)
set terminal svg size 1300,640 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/map_errors.svg'
set multiplot layout 1,3 title "Error of the force in cutting, milling at 1000 Hz, no delay. Each line ends where its method stops being stable;\nlines within one another are methods that are equal there" \
    font ',16' margins 0.06,0.985,0.32,0.83 spacing 0.03,0.1
set logscale xy
set format y '%g'
set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000)
set xrange [3:6000]
set xtics (5, 20, 100, 500, 3000)
set xlabel 'resistance of the bone, N s/m'
# A logarithmic axis has no zero.
drawn(percent) = percent > 0.01 ? percent : 0.01
stats table using (column('stable') == 1 ? log10(drawn(column('rms_error_percent'))) : NaN) name 'Error' nooutput
# Where nothing is stable there is nothing to draw but the axes.
if (!exists('Error_min')) { Error_min = 0; Error_max = 1 }
set yrange [10**(Error_min - 0.1) : 10**(Error_max + 0.1)]
of(i, grip) = column('number') == i && strcol('grip') eq grip && column('stable') == 1 ? drawn(column('rms_error_percent')) : NaN
# Methods may be equal here, above all without a delay. What is drawn earlier is wider, so that it shows on both sides of what lies on it:
# plain couplings, then those with a damper or passivity; within these hold, then interpolate.
array Order[11] = [3, 4, 5, 6, 7, 8, 9, 10, 11, 2, 1]
array Width[11] = [1.6, 1.6, 10, 6.5, 5.5, 2, 1.6, 5.5, 2, 3, 1]
array Size[11] = [0.8, 0.8, 1.8, 1.4, 1.4, 0.8, 0.8, 1.4, 0.8, 0.9, 0.4]
array Line[11] = [black, pink, '#f2a477', '#7fb3d9', '#66c5ab', '#00664b', green, '#f2a477', '#00507f', '#a34400', '#00304d']
array Mark[11] = [7, 5, 7, 7, 9, 9, 11, 5, 5, 7, 7]
array Gap[11] = [1, 1, 1, 1, 1, 1, 3, 1, 1, 1, 1]
curves(grip) = "plot 1e-12 notitle, for [n=1:11] table using 'resistance_n_s_per_m':(of(Order[n], '".grip."')) with linespoints " \
    . "pt Mark[Order[n]] ps Size[Order[n]] lw Width[Order[n]] dt Gap[Order[n]] lc rgb Line[Order[n]] title Name[Order[n]]"
unset key
set ylabel 'rms error, % of the mean force' offset 1,0
set title 'bare arm'
eval curves('bare-arm')
unset ylabel
set format y ''
set title 'light grip'
set key at screen 0.5,0.2 center top maxrows 4 Left reverse samplen 4
eval curves('light')
unset key
set title 'firm grip'
eval curves('firm')
unset multiplot
