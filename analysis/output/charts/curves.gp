# Force against depth, feed and spindle speed beside the reference: curve_depth.csv, curve_feed.csv, curve_rpm.csv.
load ARG0[1:strlen(ARG0)-strlen('curves.gp')].'style.gp'
set terminal svg size 1300,560 dynamic font 'DejaVu Sans,14' background 'white'
set output folder.'/curves.svg'
set multiplot layout 1,3 title 'Force of the bone on an upright 5 mm burr: voxel model (points) on the reference (lines)' \
    font ',17' margins 0.055,0.985,0.13,0.84 spacing 0.055,0.1
set ylabel 'N' offset 1.5,0
set yrange [-11:3]
set key at graph 0.97,1.0 top right maxrows 2 samplen 2 font ',12' opaque
curves = 'curve_depth curve_feed curve_rpm'
plot_curve(name, x) = sprintf("plot '%s/%s.csv' using '%s':'reference_x_n' with lines lw 2 lc rgb blue title 'F_x', '' using '%s':'reference_y_n' with lines lw 2 lc rgb red title 'F_y', '' using '%s':'reference_z_n' with lines lw 2 lc rgb green title 'F_z', '' using '%s':'voxels_x_n' with points pt 7 ps 0.7 lc rgb blue notitle, '' using '%s':'voxels_y_n' with points pt 7 ps 0.7 lc rgb red notitle, '' using '%s':'voxels_z_n' with points pt 7 ps 0.7 lc rgb green notitle", folder, name, x, x, x, x, x, x)
set xlabel 'depth, mm (6 mm/s, 10 000 rpm)'
eval plot_curve('curve_depth', 'depth_mm')
unset ylabel
set yrange [*:*]
set xlabel 'feed, mm/s (1 mm deep, 10 000 rpm)'
eval plot_curve('curve_feed', 'feed_mm_per_s')
set xlabel 'spindle, 1000 rpm (1 mm deep, 6 mm/s)'
eval plot_curve('curve_rpm', 'thousand_rpm')
unset multiplot
