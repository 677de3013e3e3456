# What a stiffer spring brings and costs each arm: springs.csv.
load ARG0[1:strlen(ARG0)-strlen('springs.gp')].'style.gp'
set terminal svg size 1000,480 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/springs.svg'
table = folder.'/springs.csv'
arms = 'simulated woodenhaptics_v2015 polhem_v1 aluhaptics_v2 inverse3'
set multiplot layout 1,2 title 'Springs of the shipped arms; filled: what each gets; crosses: the published couplings' font ',17'
set xlabel 'spring at the arm, N/mm'
set xrange [0:5]
set yrange [0:*]
of(name, kind, chosen, y) = strcol('arm') eq name && strcol('coupling') eq kind && column('is_chosen') == chosen ? y : NaN
set ylabel 'force passed up to, Hz'
unset key
plot table using 'stiffness_n_per_mm':(of('simulated', 'implicit', 0, column('bandwidth_hz'))) with linespoints pt 6 lw 2 lc rgb blue, \
     for [i=1:words(arms)] table using 'stiffness_n_per_mm':(of(word(arms, i), 'implicit', 1, column('bandwidth_hz'))) with points pt 7 ps 1.4 lc i
set ylabel 'force above 5 Hz, N rms'
set key right center noenhanced
plot for [i=1:words(arms)] table using 'stiffness_n_per_mm':(of(word(arms, i), 'implicit', 0, column('noise_n'))) with linespoints pt 6 lw 2 lc i title word(arms, i), \
     for [i=1:words(arms)] table using 'stiffness_n_per_mm':(of(word(arms, i), 'implicit', 1, column('noise_n'))) with points pt 7 ps 1.4 lc i notitle, \
     for [i=1:words(arms)] table using 'stiffness_n_per_mm':(of(word(arms, i), 'interpolate', 0, column('noise_n'))) with points pt 2 lc i notitle
unset multiplot
