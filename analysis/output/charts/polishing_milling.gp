# The paper's figure 7, force of the milling model against time: a column a coupling, a row a component.
load ARG0[1:strlen(ARG0)-strlen('polishing_milling.gp')].'style.gp'
set output folder.'/polishing_milling.svg'
set terminal svg size 1500,860 dynamic font 'DejaVu Sans,13' background 'white'
array Coupling[4] = ['interpolate', 'sample-estimate-interpolate', 'sample-estimate-hold', 'implicit']
array Name[4] = ['interpolate, 100 Hz (without s.-e.-h.)', 'sample-estimate-interpolate, 100 Hz', \
                 'sample-estimate-hold, 100 Hz', 'implicit, 1 kHz (mind the scale)']
array Largest[4] = [3.5, 3.5, 3.5, 0.9]
array Colour[4] = [red, amber, sky, black]
array Component[3] = ['x', 'y', 'z']
array Direction[3] = ['along the strokes', 'across', 'out of the bone']
set multiplot layout 3,4 columnsfirst title \
    'Polishing, milling model, 80 000 rpm, firm grip: force on the hand against time (figure 7 of the paper)' \
    font ',17' margins 0.06,0.99,0.075,0.885 spacing 0.04,0.035
set xrange [0:*]
do for [c=1:4] {
    do for [i=1:3] {
        set title (i == 1 ? Name[c] : '') font ',14'
        set xlabel (i == 3 ? 'time since first contact, s' : '')
        set format x (i == 3 ? '%g' : '')
        set ylabel (c == 1 ? Direction[i].', F_{'.Component[i].'}, N' : '') offset 1,0
        set yrange [-Largest[c]:Largest[c]]
        plot sprintf('%s/milling_%s.csv', folder, Coupling[c]) using 't_s':(column('force_'.Component[i].'_n')) \
            with lines lw 1 lc rgb Colour[c] notitle
    }
}
unset multiplot
