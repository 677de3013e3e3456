// Layout of the panels, so that none covers another, whatever the size of the picture.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace osteomill {

enum class Anchor { upper_left, upper_right, lower_left, lower_right, top, bottom, middle };

/// A panel asks for a place: the sizes it can take, best first, pixels.
struct PanelWish {
    Anchor anchor = Anchor::upper_left;
    std::vector<glm::vec2> sizes;
    bool may_cover_middle = false;  ///< the user asked for it and cannot do without
};

struct PanelPlace {
    glm::vec2 first{0.0f};  ///< upper left corner, pixels from the picture's upper left corner
    glm::vec2 size{0.0f};
    std::size_t choice = 0;  ///< which of the wish's sizes it is
};

/// Places for `wishes`, the most important first, in a picture of `picture` pixels with `margin` round each
/// panel. A panel goes to its anchor; where others are, it moves past them: down from an upper anchor, up
/// from a lower one. One whose first size fits nowhere there gets its next, and none if none fits: a small
/// window shows fewer panels.
/// The middle of the picture, where the burr is, stays free of all that may not cover it.
std::vector<std::optional<PanelPlace>> lay_out(std::span<const PanelWish> wishes, const glm::vec2& picture,
                                               float margin);

/// How much of the picture's width and height that is.
inline constexpr float free_middle_part = 0.2f;

}  // namespace osteomill
