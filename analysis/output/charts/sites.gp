# What a hand would not forgive, where bone ends: a panel a kind of site, each number as a share of its bar: site_points.csv.
scripts = ARG0[1:strlen(ARG0)-strlen('sites.gp')]
load scripts.'style.gp'
table = folder.'/site_points.csv'
stats table using 'kind' name 'Kind' nooutput
panels = int(Kind_max) + 1
columns = panels < 4 ? panels : 4
rows = int(ceil(panels / (1.0 * columns)))
set terminal svg size 340 * columns, 300 * rows + 60 dynamic font 'DejaVu Sans,13' background 'white'
set output folder.'/sites.svg'
set multiplot layout rows,columns title 'Where bone ends: each case as a share of its bar; below the line it is met' font ',16'
set logscale y
set yrange [0.003:300]
set xrange [-0.6:3.6]
set format y '%g'
set ytics (0.01, 0.1, 1, 10, 100)
set xtics ('energy' 0, 'stuck' 1, 'error' 2, 'jump' 3)
unset key
# A logarithmic axis has no zero; points of a column lie beside one another.
drawn(share) = share > 0.005 ? share : 0.005
beside(i) = 0.5 * ((i * 0.618034) - floor(i * 0.618034)) - 0.25
do for [panel=0:panels-1] {
    name = system(sprintf("awk -F, 'NR > 1 && $1 == %d { print $2; exit }' '%s'", panel, table))
    set title name
    plot table using (column('kind') == panel ? column('bar') + beside(column(0)) : NaN):(drawn(column('share'))):(column('share') > 1 ? 0xd55e00 : 0x0072b2) \
             with points pt 7 ps 0.4 lc rgb variable, \
         1 with lines lw 1.5 lc rgb black
}
unset multiplot
