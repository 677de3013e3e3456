# What all charts of the study share. Okabe-Ito colours: safe for colour-blind readers.
set datafile separator ','
set encoding utf8
set terminal svg size 1000,680 dynamic font 'DejaVu Sans,15' background 'white'
set grid lc rgb '#cccccc'
set border 3 lc rgb '#444444'
set tics nomirror
black = '#000000'
blue = '#0072b2'
red = '#d55e00'
green = '#009e73'
pink = '#cc79a7'
amber = '#e69f00'
sky = '#56b4e9'
grey = '#888888'
