# Edges of the burr: what falls with their number and what does not; edges.csv and tooth_period_N.csv.
load ARG0[1:strlen(ARG0)-strlen('polishing_edges.gp')].'style.gp'
set output folder.'/polishing_edges.svg'
set terminal svg size 1300,560 dynamic font 'DejaVu Sans,14' background 'white'
set multiplot layout 1,2 title \
    'Edges of the burr, milling model on rails at 2500 rpm, 10 kHz: the mean force does not know their number' \
    font ',17' margins 0.06,0.985,0.26,0.83 spacing 0.07,0.1
table = folder.'/edges.csv'
set title 'over the whole slide' font ',14'
set xlabel 'edges'
set ylabel 'length of the force, N' offset 0.5,0
set xrange [0:13]
set yrange [0:*]
set key at graph 0.5,-0.19 center top maxrows 3 Left reverse samplen 3 font ',13'
plot table using 'edges':(column('mean_n') * column('peak_over_mean')) with linespoints pt 5 ps 0.8 lw 2 lc rgb red \
         title 'peak within the tooth period, equation (1)', \
     '' using 'edges':'mean_n' with linespoints pt 7 ps 0.9 lw 2.5 lc rgb black title 'mean, equation (2): what is rendered', \
     '' using 'edges':'one_tooth_n' with linespoints pt 9 ps 1 lw 2 lc rgb blue title 'one tooth, mean of its revolution'
set xlabel 'time, ms'
set xrange [0:24]
unset ylabel
set title 'halfway through the slide, one revolution' font ',14'
set key at graph 0.5,-0.19 center top maxrows 1
plot folder.'/tooth_period_1.csv' using (1000 * column('t_s')):'force_n' with lines lw 1.5 lc rgb red title '1 edge', \
     folder.'/tooth_period_3.csv' using (1000 * column('t_s')):'force_n' with lines lw 2 lc rgb amber title '3 edges', \
     folder.'/tooth_period_6.csv' using (1000 * column('t_s')):'force_n' with lines lw 1.2 lc rgb black title '6 edges'
unset multiplot
