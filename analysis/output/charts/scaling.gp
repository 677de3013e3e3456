# Time of a step against the burr and against the bone: cost_by_diameter.csv, cost_by_volume.csv.
load ARG0[1:strlen(ARG0)-strlen('scaling.gp')].'style.gp'
set terminal svg size 1200,600 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/scaling.svg'
set multiplot layout 1,2 title 'A step of the crescent and of the full scan: half-immersed burr, 6 mm/s, 0.1 mm voxels' \
    font ',17' margins 0.07,0.985,0.24,0.88 spacing 0.08,0.1
set ylabel 'time of a step (median), µs' offset 1,0
set logscale xy
set format y '%g'
set yrange [0.5:20000]
set key below maxcols 2 samplen 2 font ',12'
lines(file, x) = sprintf("plot '%s/%s.csv' using '%s':'scan_100_hz_us' with linespoints pt 5 lw 1.5 lc rgb red title 'full scan, 100 Hz', '' using '%s':'crescent_100_hz_us' with linespoints pt 7 lw 1.5 lc rgb blue title 'crescent, 100 Hz', '' using '%s':'scan_1_khz_us' with linespoints pt 4 lw 1.5 lc rgb amber title 'full scan, 1 kHz', '' using '%s':'crescent_1_khz_us' with linespoints pt 6 lw 1.5 lc rgb sky title 'crescent, 1 kHz'", folder, file, x, x, x, x)
set xlabel 'burr diameter, mm'
set xtics (1, 1.5, 2, 3, 4, 5, 6)
set xrange [0.9:6.6]
eval lines('cost_by_diameter', 'diameter_mm')
set xlabel 'edge of the volume, voxels (5 mm burr)'
set xtics (128, 256, 512, 1024)
set xrange [110:1200]
eval lines('cost_by_volume', 'edge_voxels')
unset multiplot
