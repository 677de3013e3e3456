#include "render_client/ui/panels/layout.h"

#include <algorithm>

namespace osteomill {

namespace {

using Places = std::vector<std::optional<PanelPlace>>;

/// 0 to 1 across the room that the picture leaves to a panel.
glm::vec2 part_of(Anchor anchor) {
    switch (anchor) {
        case Anchor::upper_left:
            return {0.0f, 0.0f};
        case Anchor::upper_right:
            return {1.0f, 0.0f};
        case Anchor::lower_left:
            return {0.0f, 1.0f};
        case Anchor::lower_right:
            return {1.0f, 1.0f};
        case Anchor::top:
            return {0.5f, 0.0f};
        case Anchor::bottom:
            return {0.5f, 1.0f};
        case Anchor::middle:
            break;
    }
    return {0.5f, 0.5f};
}

bool meet(const PanelPlace& a, const PanelPlace& b, float margin) {
    return a.first.x < b.first.x + b.size.x + margin && b.first.x < a.first.x + a.size.x + margin &&
           a.first.y < b.first.y + b.size.y + margin && b.first.y < a.first.y + a.size.y + margin;
}

const PanelPlace* first_met(const Places& taken, const PanelPlace& place, float margin) {
    for (const auto& other : taken)
        if (other && meet(*other, place, margin)) return &*other;
    return nullptr;
}

PanelPlace free_middle(const glm::vec2& picture) {
    return {0.5f * (1.0f - free_middle_part) * picture, free_middle_part * picture, 0};
}

std::optional<PanelPlace> find_place(const Places& taken, const PanelWish& wish, const glm::vec2& size,
                                     const glm::vec2& picture, float margin) {
    const glm::vec2 room = picture - size - 2.0f * margin;
    if (room.x < 0.0f || room.y < 0.0f) return std::nullopt;
    const glm::vec2 part = part_of(wish.anchor);
    PanelPlace place{glm::vec2(margin) + part * room, size, 0};
    const bool upwards = part.y == 1.0f;
    // Every move goes past a panel that it never meets again.
    for (std::size_t moves = 0; moves <= taken.size(); ++moves) {
        const PanelPlace* other = first_met(taken, place, margin);
        if (!other) {
            if (!wish.may_cover_middle && meet(place, free_middle(picture), 0.0f)) return std::nullopt;
            return place;
        }
        place.first.y = upwards ? other->first.y - margin - size.y : other->first.y + other->size.y + margin;
        if (place.first.y < margin || place.first.y > margin + room.y) return std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

Places lay_out(std::span<const PanelWish> wishes, const glm::vec2& picture, float margin) {
    Places places;
    for (const PanelWish& wish : wishes) {
        std::optional<PanelPlace> found;
        for (std::size_t choice = 0; choice < wish.sizes.size() && !found; ++choice) {
            found = find_place(places, wish, wish.sizes[choice], picture, margin);
            if (found) found->choice = choice;
        }
        places.push_back(found);
    }
    return places;
}

}  // namespace osteomill
