# Where cutting is stable, a panel a method: regions_cutting.csv, region_rows.csv.
scripts = ARG0[1:strlen(ARG0)-strlen('map_cutting.gp')]
load scripts.'style.gp'
load scripts.'map_style.gp'
set output folder.'/map_cutting.svg'
table = folder.'/regions_cutting.csv'
chart_title = 'Where cutting is stable: bar where it is, thin line where it is not'
x_label = 'resistance of the bone, N s/m'
x_low = 3
set logscale x
set xrange [x_low:6000]
set xtics (5, 20, 100, 500, 3000)
load scripts.'regions.gp'
