// Quality of the displayed picture: full, or reduced for speed.
#pragma once

namespace osteomill {

struct PictureQuality {
    double scale = 1.0;   ///< resolution of the coarsest part, as a share of the picture's: 1 down to 1/4
    bool refined = true;  ///< every pixel is that of a full-quality picture

    bool operator==(const PictureQuality&) const = default;
};

}  // namespace osteomill
