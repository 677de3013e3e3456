// Difference of a picture from a reference: peak signal-to-noise ratio and structural similarity.
#pragma once

#include "render_client/volume/picture.h"

namespace osteomill::study {

/// Peak signal-to-noise ratio in dB over all pixels and channels, 10 log10(255^2 / mean squared difference);
/// infinite for equal pictures. Throws std::invalid_argument if the sizes differ.
double psnr_db(const Picture& picture, const Picture& reference);

/// Mean structural similarity of the luma (Rec. 601), 1 for equal pictures: Wang, Bovik, Sheikh, Simoncelli,
/// "Image quality assessment" (2004), with their Gaussian window of 11 x 11 pixels (sigma 1.5), K1 = 0.01 and
/// K2 = 0.03; windows are cut off at the picture's edge. Throws std::invalid_argument if the sizes differ.
double ssim(const Picture& picture, const Picture& reference);

}  // namespace osteomill::study
