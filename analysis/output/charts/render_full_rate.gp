# Frames a second in a large window, finished one by one: full_rate.csv.
load ARG0[1:strlen(ARG0)-strlen('render_full_rate.gp')].'style.gp'
set output folder.'/render_full_rate.svg'
renderer = system("head -n 1 '".folder."/gl_renderer.txt'")
table = folder.'/full_rate.csv'
set datafile columnheaders
set title "Frames a second at full quality, each finished before the next\n".renderer noenhanced font ',17'
set ylabel 'frames a second'
set logscale y
set format y '%g'
set xtics rotate by 30 right noenhanced nomirror scale 0 font ',13'
set bmargin 9
set style fill solid 0.8
set boxwidth 0.7
set key above right
set yrange [0.1:*]
set xrange [-0.6:*]
plot table using 0:'frames_per_s':xtic(strcol('bone').': '.strcol('motion')) \
         with boxes lc rgb blue title 'window: bone, tool and panels', \
     table using 0:(column('frames_per_s')):(sprintf('%.4g', column('frames_per_s'))) with labels offset 0,0.6 font ',11' notitle, \
     240 with lines dt 2 lw 1.5 lc rgb black title 'goal on a data-centre GPU'
