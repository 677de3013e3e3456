# Regions of stability, a panel a method: TABLE with x_low, x_high, y and stable for each grip, region_rows.csv.
# Loaded by map_cutting.gp and map_wall.gp, which set `table`, `x_label` and the x axis.
eval names(table)
panels = 0
do for [i=1:11] { panels = panels + (Name[i] ne '' ? 1 : 0) }
columns = panels < 4 ? panels : 4
lines = (panels + columns - 1) / columns
height = 75 + 235 * lines + 95
set terminal svg size 1300,height dynamic font 'DejaVu Sans,14' background 'white'
array Shade[3] = ['#0b2a4a', '#2f7fb8', '#8cc4e8']
array Grip[3] = ['bare arm', 'light grip', 'firm grip']
stats folder.'/region_rows.csv' using 'y' name 'Row' nooutput
set yrange [Row_min - 0.6 : Row_max + 0.6]
unset key
set grid noytics
set errorbars 0
set ytics scale 0
set style fill solid noborder
of(i, grip, is_stable, what) = column('number') == i && column('grip') == grip && column('stable') == is_stable ? column(what) : NaN
left = 0.075
right = 0.99
top = 1.0 - 75.0 / height
bottom = 100.0 / height
across = 0.015
down = 50.0 / height
panel_width = (right - left - (columns - 1) * across) / columns
panel_height = (top - bottom - (lines - 1) * down) / lines
set multiplot
panel = 0
do for [i=1:11] {
    if (Name[i] ne '') {
        at_column = panel % columns
        at_line = panel / columns
        set lmargin at screen left + at_column * (panel_width + across)
        set rmargin at screen left + at_column * (panel_width + across) + panel_width
        set tmargin at screen top - at_line * (panel_height + down)
        set bmargin at screen top - at_line * (panel_height + down) - panel_height
        set title Name[i] offset 0,-0.6 font ',15'
        if (panel + columns >= panels) { set xlabel x_label offset 0,0.4; set format x '%g' } else { unset xlabel; set format x '' }
        if (panel == 0) {
            set label 1 chart_title at screen 0.5, 1.0 - 20.0 / height center font ',18'
            do for [g=1:3] {
                set object g rectangle from screen 0.3 + 0.14 * (g - 1), 20.0 / height to screen 0.33 + 0.14 * (g - 1), 32.0 / height fs solid noborder fc rgb Shade[g]
                set label 1 + g Grip[g] at screen 0.335 + 0.14 * (g - 1), 26.0 / height left
            }
        } else {
            unset label
            unset object
        }
        # What the rows' names are: a heading over them, and a line that says what it means.
        if (at_column == 0) {
            set label 10 'rate  delay' at screen left - 10.0 / 1300, screen top - at_line * (panel_height + down) + 8.0 / height right font ',12'
        }
        if (panel == 0) { set label 11 'rows: rate of milling; delay, ticks of 1 ms' at screen 0.012, screen 26.0 / height left font ',12' }
        # Rows are named by an invisible plot, in the first column only.
        set format y ''
        strips = "for [g=1:3] table using (of(i, g, 0, 'x_low')):'y':(of(i, g, 0, 'x_low')):(of(i, g, 0, 'x_high')) with xerrorbars pt 0 lw 1 lc rgb '#c8c8c8', " \
               . "for [g=1:3] table using (of(i, g, 1, 'x_low')):'y':'x_low':'x_high':(column('y') - 0.13):(column('y') + 0.13) with boxxyerror fs solid noborder lc rgb Shade[g]"
        rows = at_column == 0 ? "folder.'/region_rows.csv' using (x_low):'y':ytic(2) with points pt 0 ps 0, " : ''
        eval 'plot '.rows.strips
        panel = panel + 1
    }
}
unset multiplot
