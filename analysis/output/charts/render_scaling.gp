# Frame time against the size of volume and window: frames_by_volume.csv, frames_by_window.csv.
load ARG0[1:strlen(ARG0)-strlen('render_scaling.gp')].'style.gp'
set terminal svg size 1200,600 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/render_scaling.svg'
renderer = system("head -n 1 '".folder."/gl_renderer.txt'")
set multiplot layout 1,2 title "A whole frame at full quality against what it shows and where\n".renderer \
    font ',17' noenhanced margins 0.07,0.985,0.24,0.84 spacing 0.08,0.1
set ylabel 'time of a frame (median), ms' offset 1,0
set logscale xy
set format '%g'
set key below maxcols 2 samplen 2 font ',12'
lines(file, x) = sprintf("plot '%s/%s.csv' using '%s':'slices_ms' with linespoints pt 5 lw 1.5 lc rgb red title 'slices', '' using '%s':'raycast_ms' with linespoints pt 7 lw 1.5 lc rgb blue title 'rays shaded by gradient (default)', '' using '%s':'raycast_surface_voxels_ms' with linespoints pt 6 lw 1.5 lc rgb sky title 'rays to surface voxels'", folder, file, x, x, x)
set xrange [56:450]
set xlabel 'edge of the volume, voxels (the same shape)'
set xtics (64, 96, 128, 192, 256, 384, 512)
eval lines('frames_by_volume', 'edge_voxels')
set xrange [15:1500]
set xlabel 'pixels of the window, thousands (tooth phantom)'
set xtics (20, 50, 100, 200, 500, 1000)
eval lines('frames_by_window', 'kilopixels')
unset multiplot
