# Measured forces against what the fitted coefficients say, a panel a material: residuals.csv.
load ARG0[1:strlen(ARG0)-strlen('calibration_fit.gp')].'style.gp'
set output folder.'/calibration_fit.svg'
table = folder.'/residuals.csv'
stats table using (column('material_number')) name 'M' nooutput
materials = int(M_max)
array Material[materials]
stats table using (Material[int(column('material_number'))] = strcol('material'), 0) nooutput
columns = materials < 3 ? materials : 3
rows = int(ceil(materials / (1.0 * columns)))
set terminal svg size 120+620*columns,640*rows dynamic font 'DejaVu Sans,15' background 'white'
set multiplot layout rows,columns title 'Mean forces of the bone on the burr: measured, with their spread, against fitted' font ',17'
set xlabel 'fitted, N'
set ylabel 'measured, N'
set key top left Left reverse samplen 1
# gnuplot draws a white disc behind each point with a bar; of nearly nothing.
set pointintervalbox 0.001
of(m, a, what) = column('material_number') == m && column('axis_number') == a ? column(what) : NaN
do for [m=1:materials] {
    set title Material[m] noenhanced
    plot x with lines lw 1.5 lc rgb grey title 'equal', \
         table using (of(m, 1, 'fitted_n')):(of(m, 1, 'measured_n')):'spread_n' with yerrorbars pt 7 ps 0.5 lw 1.5 lc rgb blue title 'along the feed', \
         '' using (of(m, 2, 'fitted_n')):(of(m, 2, 'measured_n')):'spread_n' with yerrorbars pt 5 ps 0.45 lw 1.5 lc rgb red title 'across, to the left', \
         '' using (of(m, 3, 'fitted_n')):(of(m, 3, 'measured_n')):'spread_n' with yerrorbars pt 9 ps 0.6 lw 1.5 lc rgb green title 'up'
}
unset multiplot
