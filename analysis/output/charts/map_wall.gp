# Where pressing on a wall is stable, a panel a method: regions_wall.csv, region_rows.csv.
scripts = ARG0[1:strlen(ARG0)-strlen('map_wall.gp')]
load scripts.'style.gp'
load scripts.'map_style.gp'
set output folder.'/map_wall.svg'
table = folder.'/regions_wall.csv'
chart_title = 'Where pressing on bone with the spindle off is stable: bar where it is, thin line where it is not'
x_label = 'stiffness that the arm claims, N/mm'
x_low = 0.06
set logscale x
set xrange [x_low:2.4]
set xtics (0.1, 0.2, 0.4, 0.8, 1.5)
load scripts.'regions.gp'
