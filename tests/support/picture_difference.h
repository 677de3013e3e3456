// How much of one picture of a screen is otherwise than in another.
#pragma once

#include <cstddef>
#include <cstdlib>

#include "render_client/volume/picture.h"

namespace osteomill::testing {

/// The part of the pixels of which a channel differs by more than rounding and a moving cursor of text do.
inline double difference(const Picture& a, const Picture& b) {
    if (a.size_px != b.size_px) return 1.0;
    int differing = 0;
    for (std::size_t pixel = 0; pixel < a.rgb.size(); pixel += 3) {
        bool differs = false;
        for (std::size_t channel = 0; channel < 3; ++channel)
            differs = differs || std::abs(a.rgb[pixel + channel] - b.rgb[pixel + channel]) > 12;
        differing += differs ? 1 : 0;
    }
    return 3.0 * differing / static_cast<double>(a.rgb.size());
}

}  // namespace osteomill::testing
