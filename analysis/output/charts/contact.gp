# The older contact models beside the milling force: contact.csv.
load ARG0[1:strlen(ARG0)-strlen('contact.gp')].'style.gp'
set output folder.'/contact.svg'
table = folder.'/contact.csv'
set title 'Force of the bone on an upright 5 mm burr: contact models at rest, milling on its way'
set xlabel 'depth, mm'
set ylabel 'length of the force, N'
set xrange [0:2.5]
set yrange [0:10]
set key top left Left reverse samplen 3 opaque
plot table using 'depth_mm':'milling 6 mm/s' with lines lw 3 lc rgb black title 'milling at 6 mm/s (reference)', \
     '' using 'depth_mm':'milling 2 mm/s' with lines lw 3 dt 2 lc rgb black title 'milling at 2 mm/s (reference)', \
     '' using 'depth_mm':'point-spring' with linespoints pt 6 ps 1.2 lw 1.5 lc rgb blue title 'point-spring', \
     '' using 'depth_mm':'petersik' with linespoints pt 5 ps 0.6 lw 1.5 lc rgb red title 'petersik', \
     '' using 'depth_mm':'morris' with linespoints pt 9 ps 0.7 lw 1.5 lc rgb green title 'morris', \
     '' using 'depth_mm':'agus' with linespoints pt 11 ps 0.7 lw 1.5 lc rgb pink title 'agus'
