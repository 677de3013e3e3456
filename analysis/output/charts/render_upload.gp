# What it costs to take a carve over into the textures: upload.csv.
load ARG0[1:strlen(ARG0)-strlen('render_upload.gp')].'style.gp'
set output folder.'/render_upload.svg'
renderer = system("head -n 1 '".folder."/gl_renderer.txt'")
set title "Taking a carve over into the textures: one ball out of the tooth phantom\n".renderer noenhanced font ',17'
set xlabel 'diameter of the ball, mm'
set ylabel 'upload and what follows from it (median), ms'
set logscale y
set format y '%g'
set key top left samplen 2
set yrange [0.003:100]
table = folder.'/upload.csv'
plot table using 'diameter_mm':'surface_voxels_ms' with linespoints pt 6 lw 1.5 lc rgb sky \
         title 'with surface voxels shaded again', \
     table using 'diameter_mm':'gradient_ms' with linespoints pt 7 lw 1.5 lc rgb blue \
         title 'fractions and skipping map (default)', \
     table using 'diameter_mm':'gradient_ms':(sprintf('%d bricks', column('bricks'))) with labels \
         offset 0,-1.2 font ',11' tc rgb blue notitle, \
     1 with lines dt 2 lw 1.5 lc rgb black title 'goal for the 5 mm burr'
