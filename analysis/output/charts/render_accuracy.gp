# Frame time against accuracy of pictures, a panel for each bone and view: accuracy.csv.
load ARG0[1:strlen(ARG0)-strlen('render_accuracy.gp')].'style.gp'
table = folder.'/accuracy.csv'
stats table using 'panel_number' nooutput
panels = int(STATS_max)
columns = panels > 1 ? 2 : 1
rows = (panels + columns - 1) / columns
# Room for the legend, pixels.
legend = 190.0
height = 620*rows + 30 + legend
set terminal svg size (columns > 1 ? 900*columns + 100 : 1250),height dynamic font 'DejaVu Sans,15' background 'white'
set output folder.'/render_accuracy.svg'
array Family[7] = ['rays shaded by gradient', 'rays to surface voxels', 'rays without skipping', \
                   'rays at lower resolution', 'slices shaded by gradient', 'slices of surface voxels (published)', \
                   'rays through see-through bone']
array Colour[7] = [blue, sky, grey, green, red, amber, black]
array Point[7] = [7, 6, 3, 9, 5, 4, 11]
# What the families of the table are, and what changes along each line, from above.
array Title[7] = ['rays, lit by the gradient', 'rays to surface voxels', 'rays that skip no empty bricks', \
                  'rays at lower resolution', 'slices, lit by the gradient', 'slices of surface voxels (published)', \
                  'rays through see-through bone']
settings(i) = system("awk -F, '$1 == 1 && $5 == \"".Family[i]."\" { print $6 }' '".table."' | paste -sd, | sed 's/, *\\(step\\|spacing\\) /, /g; s/,\\([^ ]\\)/, \\1/g'")
do for [i=1:7] { Title[i] = Title[i].': '.settings(i) }
of(p, i, what) = column('panel_number') == p && strcol('family') eq Family[i] ? column(what) : NaN
set datafile missing NaN
set logscale x
set format x '%g'
set xrange [1 < * : *]
set offsets graph 0.05, graph 0.12, graph 0.08, graph 0.08
set xlabel 'time of a frame (median), ms'
set ylabel 'PSNR against the reference image, dB'
renderer = system("head -n 1 '".folder."/gl_renderer.txt'")
bottom = legend / height
set multiplot layout rows,columns title "What a picture costs and what it is worth; steps and spacings in voxels, along each line from above\n".renderer \
    font ',18' noenhanced margins (columns > 1 ? 0.06 : 0.1),0.985,bottom + 0.05,1 - 100/height spacing 0.07,0.11
do for [p=1:panels] {
    set title system(sprintf("awk -F, '$1 == %d { print $2; exit }' '%s'", p, table)) offset 0,-0.5
    if (p == 1) {
        set key at screen 0.5,bottom*0.62 center top maxrows 5 Left reverse samplen 2 width 1 font ',14'
    } else {
        unset key
    }
    plot for [i=1:7] table using 'frame_ms':(of(p, i, 'psnr_db')) with linespoints \
             lc rgb Colour[i] pt Point[i] ps 1.1 lw 1.2 title Title[i], \
         table using 'frame_ms':(column('panel_number') == p && column('is_default') == 1 ? column('psnr_db') : NaN) \
             with points pt 6 ps 2.2 lw 2.5 lc rgb black title 'the default', \
         40 with lines dt 2 lw 1.5 lc rgb black title 'goal of full quality, 40 dB'
}
unset multiplot
