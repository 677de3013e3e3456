// Quality of the picture on show: all that there is, or less for the sake of speed.
#pragma once

namespace osteomill {

struct PictureQuality {
    double scale = 1.0;   ///< resolution of the coarsest part, of that of the picture: 1 down to 1/4
    bool refined = true;  ///< every pixel is that of a full-quality picture

    bool operator==(const PictureQuality&) const = default;
};

}  // namespace osteomill
