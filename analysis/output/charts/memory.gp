# Memory against bone, scenes with what they cost and how long they take to start: memory_bone.csv, memory_box.csv, memory_scenes.csv.
load ARG0[1:strlen(ARG0)-strlen('memory.gp')].'style.gp'
set output folder.'/memory.svg'
set title 'Memory follows the bone, not the box around it (0.1 mm voxels)'
set xlabel 'bone, mm^3'
set ylabel 'memory, MiB'
set logscale xy
set format x '%.0f'
set format y '%g'
set key bottom right
set xrange [20:1e6]
set rmargin 5
set yrange [0.02:30000]
bytes_per_mm3 = 1000.0
plot folder.'/memory_bone.csv' using 'bone_mm3':'mebibytes' with linespoints pt 7 lw 1.5 lc rgb blue \
         title 'solid cubes of 3 to 51 mm', \
     folder.'/memory_box.csv' using 'bone_mm3':'mebibytes' with points pt 6 ps 2 lw 1.5 lc rgb red \
         title 'a cube of 13 mm in boxes of 13 to 102 mm', \
     '' using 'bone_mm3':(column('box_mm3') * bytes_per_mm3 / 2**20) with points pt 2 lw 1.5 lc rgb grey \
         title 'what those boxes would take', \
     folder.'/memory_scenes.csv' using 'bone_mm3':'mebibytes' with points pt 9 ps 1.3 lc rgb green \
         title 'scenes', \
     '' using 'bone_mm3':'mebibytes':(sprintf('%s: %.0f B/mm^3, %.1f s', strcol('name'), column('bytes_per_mm3'), \
         column('start_s'))) with labels left rotate by 55 offset 0.3,0.9 font ',12' tc rgb green notitle
