# Frame time against accuracy of pictures, a panel for each bone and view: accuracy.csv.
load ARG0[1:strlen(ARG0)-strlen('render_accuracy.gp')].'style.gp'
table = folder.'/accuracy.csv'
stats table using 'panel_number' nooutput
panels = int(STATS_max)
columns = panels > 1 ? 2 : 1
rows = (panels + columns - 1) / columns
set terminal svg size 900*columns + 100,620*rows + 160 dynamic font 'DejaVu Sans,15' background 'white'
set output folder.'/render_accuracy.svg'
array Family[6] = ['rays shaded by gradient', 'rays to surface voxels', 'rays without skipping', \
                   'rays at lower resolution', 'slices shaded by gradient', 'slices of surface voxels (published)']
array Colour[6] = [blue, sky, grey, green, red, amber]
array Point[6] = [7, 6, 3, 9, 5, 4]
of(p, i, what) = column('panel_number') == p && strcol('family') eq Family[i] ? column(what) : NaN
set datafile missing NaN
set logscale x
set format x '%g'
set xrange [1 < * : *]
set offsets graph 0.05, graph 0.12, graph 0.08, graph 0.08
set xlabel 'time of a frame (median), ms'
set ylabel 'PSNR against the reference image, dB'
renderer = system("head -n 1 '".folder."/gl_renderer.txt'")
bottom = 130.0 / (620*rows + 160)
set multiplot layout rows,columns title "What a picture costs and what it is worth\n{/*0.7 ".renderer.'}' \
    font ',18' noenhanced margins 0.06,0.985,bottom + 0.05,1 - 0.75*bottom spacing 0.07,0.11
do for [p=1:panels] {
    set title system(sprintf("awk -F, '$1 == %d { print $2; exit }' '%s'", p, table)) offset 0,-0.5
    if (p == 1) {
        set key at screen 0.5,bottom*0.62 center top maxrows 3 Left reverse samplen 2 width 1 font ',14'
    } else {
        unset key
    }
    plot for [i=1:6] table using 'frame_ms':(of(p, i, 'psnr_db')) with linespoints \
             lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2 title Family[i], \
         for [i=1:6] table using 'frame_ms':(of(p, i, 'psnr_db')):'label' with labels \
             left offset 0.8,0.5 font ',11' tc rgb Colour[i] notitle, \
         table using 'frame_ms':(column('panel_number') == p && column('is_default') == 1 ? column('psnr_db') : NaN) \
             with points pt 6 ps 2.2 lw 2.5 lc rgb black title 'the default', \
         40 with lines dt 2 lw 1.5 lc rgb black title 'goal of full quality'
}
unset multiplot
