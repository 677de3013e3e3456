# What the charts of the stability map share: a colour and a point for each method, in the order of map_methods().
# Families share a colour: what runs on a hold is red, on interpolation blue, on an estimate green.
array Colour[11] = [black, pink, red, blue, green, green, green, red, blue, red, blue]
# The same as numbers, for columns that choose a colour.
array Rgb[11]
do for [i=1:11] { Rgb[i] = int('0x'.Colour[i][2:7]) }
array Point[11] = [7, 5, 7, 7, 9, 8, 11, 5, 5, 6, 6]
# The methods that a table has, by number: Name[i] is empty for the others.
array Name[11]
do for [i=1:11] { Name[i] = '' }
names(table) = sprintf("stats '%s' using (Name[int(column('number'))] = strcol('method'), 0) nooutput", table)
