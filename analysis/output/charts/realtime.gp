# How late the haptic loop wakes and how long its work takes, next to cyclictest: latencies.csv.
load ARG0[1:strlen(ARG0)-strlen('realtime.gp')].'style.gp'
set terminal svg size 1200,900 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/realtime.svg'
table = folder.'/latencies.csv'
loads = system(sprintf("tail -n +2 '%s' | cut -d, -f1 | uniq", table))
load_of(column) = system(sprintf("tail -n +2 '%s' | cut -d, -f1 | uniq | sed -n %dp", table, column))
columns = int(system(sprintf("tail -n +2 '%s' | cut -d, -f1 | uniq | wc -l", table)))
has_cyclictest = int(system(sprintf("grep -c ',cyclictest,' '%s' || true", table))) > 0
set multiplot layout 2,columns columnsfirst title \
    "The haptic loop at 1 kHz: milling, recording, two clients".(has_cyclictest ? '; cyclictest in turns with it' : '') font ',17' \
    margins 0.075,0.985,0.09,0.87 spacing 0.085,0.13
set logscale x
set xrange [0.05:20000]
set xlabel 'microseconds'
set format x '%g'
set key top right samplen 2 font ',12'
set arrow 1 from 1000, graph 0 to 1000, graph 1 nohead dt 3 lc rgb grey
of(load, what) = sprintf("< grep '^%s,%s,' '%s'", load, what, table)
do for [column = 1:columns] {
    load_name = load_of(column)
    set title load_name eq 'no load' ? 'no load besides its own' : 'under '.load_name
    unset logscale y
    set yrange [0:*]
    set format y '%g'
    set ylabel 'share of a bin (a sixth of an octave), %'
    plot of(load_name, 'wakeup') using (sqrt($3*$4)):(100*$5) with histeps lw 2 lc rgb blue title 'wake-up of the haptic loop', \
         has_cyclictest ? of(load_name, 'cyclictest') : '/dev/null' using (sqrt($3*$4)):(100*$5) with histeps lw 2 lc rgb red title 'wake-up of cyclictest', \
         of(load_name, 'haptic tick') using (sqrt($3*$4)):(100*$5) with histeps lw 1.5 lc rgb green title 'duration of a haptic tick', \
         of(load_name, 'milling step') using (sqrt($3*$4)):(100*$5) with histeps lw 1.5 lc rgb amber title 'duration of a milling step'
    unset title
    set logscale y
    set yrange [1e-6:1]
    set format y '10^{%T}'
    set ylabel 'share that takes longer'
    plot of(load_name, 'wakeup') using 4:($6 > 0 ? $6 : 1/0) with lines lw 2 lc rgb blue notitle, \
         has_cyclictest ? of(load_name, 'cyclictest') : '/dev/null' using 4:($6 > 0 ? $6 : 1/0) with lines lw 2 lc rgb red notitle, \
         of(load_name, 'haptic tick') using 4:($6 > 0 ? $6 : 1/0) with lines lw 1.5 lc rgb green notitle, \
         of(load_name, 'milling step') using 4:($6 > 0 ? $6 : 1/0) with lines lw 1.5 lc rgb amber notitle, \
         1e-3 with lines dt 2 lc rgb black title 'p99.9'
}
unset multiplot
