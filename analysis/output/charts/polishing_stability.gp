# Where polishing chatters, by coupling, spindle speed and grip: speed_and_grip.csv.
load ARG0[1:strlen(ARG0)-strlen('polishing_stability.gp')].'style.gp'
set output folder.'/polishing_stability.svg'
set terminal svg size 1300,820 dynamic font 'DejaVu Sans,14' background 'white'
table = folder.'/speed_and_grip.csv'
array Coupling[4] = ['interpolate', 'sample-estimate-interpolate', 'sample-estimate-hold', 'implicit']
array Name[4] = ['interpolate, 100 Hz (as published)', 'sample-estimate-interpolate, 100 Hz', \
                 'sample-estimate-hold, 100 Hz', 'implicit, 1 kHz']
grip_place(g) = g eq 'light' ? 1 : g eq 'medium' ? 2 : g eq 'firm' ? 3 : 4
speed_place(rpm) = log(rpm / 10000.0) / log(2)
of(i, arm, what) = strcol('coupling') eq Coupling[i] && strcol('arm') eq arm ? what : NaN
set datafile missing NaN
# Blue is steady, red chatters; they meet at the bar of 0.2 N.
set palette defined (-1.7 '#67a9cf', -0.7 '#e4f0f6', -0.7 '#fde3d5', 0.45 '#d6604d')
set cbrange [-1.7:0.45]
unset colorbox
unset grid
set xrange [-0.5:5.5]
set yrange [0.5:4.5]
set xtics ('10' 0, '20' 1, '40' 2, '80' 3, '160' 4, '320' 5) scale 0
set ytics ('light' 1, 'medium' 2, 'firm' 3, 'braced' 4) scale 0
set style fill solid 1.0 border lc rgb 'white'
set multiplot layout 2,2 title \
    "Polishing: limit cycle of the force on the hand, N rms; blue below 0.2 N, red chatters\n\
{/*0.85 large: the arm as it is; in brackets: an arm without friction and encoder steps, which hide limit cycles}" \
    font ',17' margins 0.075,0.985,0.085,0.84 spacing 0.075,0.13
do for [i=1:4] {
    set title Name[i] font ',15'
    set xlabel (i > 2 ? 'spindle, 1000 rpm' : '')
    set ylabel (i % 2 == 1 ? 'grip' : '')
    plot table using (of(i, 'real', speed_place(column('rpm')))):(grip_place(strcol('grip'))):(0.5):(0.5):\
             (log10(column('limit_cycle_n'))) with boxxyerror lc palette notitle, \
         '' using (of(i, 'real', speed_place(column('rpm')))):(grip_place(strcol('grip'))):\
             (sprintf('%.2f', column('limit_cycle_n'))) with labels offset 0,0.5 font ',14' notitle, \
         '' using (of(i, 'ideal', speed_place(column('rpm')))):(grip_place(strcol('grip'))):\
             (sprintf('(%.2f)', column('limit_cycle_n'))) with labels offset 0,-0.6 font ',11' tc rgb '#444444' notitle
}
unset multiplot
