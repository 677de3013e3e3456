// Layout of the panels, so that none covers another, whatever the size of the picture.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

namespace osteomill {

enum class Anchor { upper_left, upper_right, lower_left, lower_right, top, bottom, middle };

/// A panel asks for a place: the sizes it can take, best first, pixels.
struct PanelRequest {
    Anchor anchor = Anchor::upper_left;
    std::vector<glm::vec2> sizes;
    bool may_cover_middle = false;  ///< a page or a question: it wants to be read and answered
    bool is_kept = false;           ///< space for its last size is kept, whatever is more important
    bool is_requested = false;      ///< the user opened it: others that were opened shrink for it
    bool gives_way = false;         ///< to the burr, wherever that is; a panel with buttons must not flee
};

struct PanelPlace {
    glm::vec2 first{0.0f};  ///< upper left corner, pixels from the picture's upper left corner
    glm::vec2 size{0.0f};
    std::size_t choice = 0;  ///< which of the request's sizes it is
};

/// Places for `requests`, the most important first, in a picture of `picture` pixels with `margin` round each
/// panel. A panel goes to its anchor; past others it moves down from an upper anchor, up from a lower one. If
/// its first size fits nowhere it gets the next, and none if none fits: a small window shows fewer panels.
/// Panels that must not cover the working area leave the middle of the picture free; panels that give way
/// also leave `burr` free, the burr's part of the picture. The largest of the panels that the user opened
/// shrinks until all have a place, or none can shrink further.
std::vector<std::optional<PanelPlace>> lay_out(std::span<const PanelRequest> requests,
                                               const glm::vec2& picture, float margin,
                                               const std::optional<PanelPlace>& burr = std::nullopt);

/// Sizes for a panel of controls: whole, then lower, then as narrow as fits beside the free middle, last its
/// first line alone. Smaller than whole it scrolls.
std::vector<glm::vec2> shrinking_sizes(const glm::vec2& whole, const glm::vec2& picture, float margin,
                                       float line_height);

/// The first of `places` for a label of `size` that lies in the picture and meets none of the panels.
std::optional<glm::vec2> free_place(std::span<const glm::vec2> places, const glm::vec2& size,
                                    std::span<const std::optional<PanelPlace>> panels,
                                    const glm::vec2& picture);

/// Scale of panels that are requested at `wanted` times the usual size: smaller in a window without space for
/// it, but never below the usual size for that reason.
float scale_that_fits(float wanted, const glm::vec2& picture);

/// How much of the picture's width and height that is.
inline constexpr float free_middle_part = 0.2f;

}  // namespace osteomill
