# The paper's figure 8, force of the point spring against time: a column a coupling, a row a component.
load ARG0[1:strlen(ARG0)-strlen('polishing_point_spring.gp')].'style.gp'
set output folder.'/polishing_point_spring.svg'
set terminal svg size 1300,860 dynamic font 'DejaVu Sans,13' background 'white'
array Coupling[3] = ['interpolate', 'sample-estimate-interpolate', 'sample-estimate-hold']
array Name[3] = ['interpolate, 100 Hz (without s.-e.-h.)', 'sample-estimate-interpolate, 100 Hz', \
                 'sample-estimate-hold, 100 Hz']
array Largest[3] = [1.2, 1.2, 1.2]
array Colour[3] = [red, amber, sky]
array Component[3] = ['x', 'y', 'z']
array Direction[3] = ['along the strokes', 'across', 'out of the bone']
set multiplot layout 3,3 columnsfirst title \
    'Polishing, point spring, firm grip: force on the hand against time (figure 8 of the paper)' \
    font ',17' margins 0.06,0.99,0.075,0.885 spacing 0.04,0.035
set xrange [0:*]
do for [c=1:3] {
    do for [i=1:3] {
        set title (i == 1 ? Name[c] : '') font ',14'
        set xlabel (i == 3 ? 'time since first contact, s' : '')
        set format x (i == 3 ? '%g' : '')
        set ylabel (c == 1 ? Direction[i].', F_{'.Component[i].'}, N' : '') offset 1,0
        set yrange [-Largest[c]:Largest[c]]
        plot sprintf('%s/point-spring_%s.csv', folder, Coupling[c]) using 't_s':(column('force_'.Component[i].'_n')) \
            with lines lw 1 lc rgb Colour[c] notitle
    }
}
unset multiplot
