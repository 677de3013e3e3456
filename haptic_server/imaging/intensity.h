// From stored grey values to HU, for files that do not say how.
#pragma once

#include "haptic_server/imaging/itk_image.h"

namespace osteomill {

/// HU = slope * value + intercept, in place.
void rescale(ScanImage& scan, double slope, double intercept);

/// For data without HU (MRI, 8-bit scans): `low` becomes 0 HU, `high` 2000 HU (between dentine and enamel),
/// straight in between and clamped to -1000 to 3000 HU beyond. low < high.
void map_intensity_window(ScanImage& scan, double low, double high);

}  // namespace osteomill
