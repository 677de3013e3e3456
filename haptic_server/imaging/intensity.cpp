#include "haptic_server/imaging/intensity.h"

#include <algorithm>
#include <span>

namespace osteomill {

namespace {

std::span<float> values_of(ScanImage& scan) {
    return {scan.GetBufferPointer(), scan.GetBufferedRegion().GetNumberOfPixels()};
}

}  // namespace

void rescale(ScanImage& scan, double slope, double intercept) {
    for (float& value : values_of(scan)) value = static_cast<float>(slope * value + intercept);
}

void map_intensity_window(ScanImage& scan, double low, double high) {
    constexpr double high_hu = 2000.0;
    const double slope = high_hu / (high - low);
    for (float& value : values_of(scan))
        value = static_cast<float>(std::clamp(slope * (value - low), -1000.0, 3000.0));
}

}  // namespace osteomill
