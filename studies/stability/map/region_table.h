// The regions of stability as boxes for a chart: a panel for each method, resistance (or a wall's stiffness)
// along x, milling rate and delay along y, and in each row a strip for each grip.
#pragma once

#include "analysis/output/table.h"
#include "studies/stability/map/whole_map.h"

namespace osteomill::study {

/// number,method,grip,x_low,x_high,y,stable: a box for each run of neighbouring points of the map's part in
/// that scene that are alike. x in N s/m or N/mm, boxes meeting halfway (on a logarithmic scale) between
/// points; y is the strip's middle, strips of a row 0.3 apart; grip 1 to 3 in the order of map_grips().
Table region_table_of(const WholeMap& map, MapScene scene);

/// y,label: of the rows above.
Table region_rows_of(const WholeMap& map);

}  // namespace osteomill::study
