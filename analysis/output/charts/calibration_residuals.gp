# What the fit leaves of each force, in spreads, against the force, a panel a material: residuals.csv.
load ARG0[1:strlen(ARG0)-strlen('calibration_residuals.gp')].'style.gp'
set output folder.'/calibration_residuals.svg'
table = folder.'/residuals.csv'
stats table using (column('material_number')) name 'M' nooutput
materials = int(M_max)
array Material[materials]
stats table using (Material[int(column('material_number'))] = strcol('material'), 0) nooutput
stats table using (abs(column('residual_in_spreads'))) name 'R' nooutput
columns = materials < 3 ? materials : 3
rows = int(ceil(materials / (1.0 * columns)))
set terminal svg size 120+620*columns,560*rows dynamic font 'DejaVu Sans,15' background 'white'
set multiplot layout rows,columns title 'Measured less fitted force: 95 % should lie between the dashed lines' font ',17'
set xlabel 'fitted, N'
set ylabel 'residual, spreads'
largest = R_max > 3 ? 1.3 * R_max : 3.9
set yrange [-largest:largest]
set key top center maxrows 1 samplen 1
of(m, a) = column('material_number') == m && column('axis_number') == a ? column('fitted_n') : NaN
do for [m=1:materials] {
    set title Material[m] noenhanced
    plot 1.96 with lines lw 1.5 dt 2 lc rgb grey notitle, -1.96 with lines lw 1.5 dt 2 lc rgb grey notitle, \
         0 with lines lw 1.5 lc rgb grey notitle, \
         table using (of(m, 1)):'residual_in_spreads' with points pt 7 ps 0.8 lc rgb blue title 'along the feed', \
         '' using (of(m, 2)):'residual_in_spreads' with points pt 5 ps 0.7 lc rgb red title 'across', \
         '' using (of(m, 3)):'residual_in_spreads' with points pt 9 ps 0.9 lc rgb green title 'up'
}
unset multiplot
