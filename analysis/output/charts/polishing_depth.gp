# The paper's figure 6, cutting depth against time: as_meant.csv and the series of the runs, MODEL_COUPLING.csv.
load ARG0[1:strlen(ARG0)-strlen('polishing_depth.gp')].'style.gp'
set terminal svg size 1300,560 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/polishing_depth.svg'
set multiplot layout 1,2 title 'Polishing a cube of bone: cutting depth against time (figure 6 of the paper)' \
    font ',17' margins 0.055,0.985,0.27,0.84 spacing 0.06,0.1
series(model, coupling) = sprintf('%s/%s_%s.csv', folder, model, coupling)
set xlabel 'time since first contact, s'
set ylabel "depth of the burr's lowest point, mm" offset 0.5,0
set xrange [0:*]
set yrange [-0.5:4.5]
set key at screen 0.5,0.13 center top maxrows 2 Left reverse samplen 2.5 font ',13'
set title 'milling, 80 000 rpm' font ',15'
plot series('milling', 'interpolate') using 't_s':'depth_mm' with lines lw 1 lc rgb red title 'interpolate, 100 Hz', \
     series('milling', 'sample-estimate-interpolate') using 't_s':'depth_mm' with lines lw 1 lc rgb amber \
         title 'sample-estimate-interpolate, 100 Hz', \
     series('milling', 'sample-estimate-hold') using 't_s':'depth_mm' with lines lw 1 lc rgb sky \
         title 'sample-estimate-hold, 100 Hz', \
     series('milling', 'implicit') using 't_s':'depth_mm' with lines lw 3 lc rgb black title 'implicit, 1 kHz', \
     folder.'/as_meant.csv' using 't_s':'depth_mm' with lines lw 2 dt 2 lc rgb green title 'as the hand means it'
unset ylabel
set title 'point spring' font ',15'
unset key
plot series('point-spring', 'interpolate') using 't_s':'depth_mm' with lines lw 1 lc rgb red title 'interpolate, 100 Hz', \
     series('point-spring', 'sample-estimate-interpolate') using 't_s':'depth_mm' with lines lw 1 lc rgb amber \
         title 'sample-estimate-interpolate, 100 Hz', \
     series('point-spring', 'sample-estimate-hold') using 't_s':'depth_mm' with lines lw 1 lc rgb sky \
         title 'sample-estimate-hold, 100 Hz', \
     folder.'/as_meant.csv' using 't_s':'depth_mm' with lines lw 2 dt 2 lc rgb green title 'as the hand means it'
unset multiplot
