#include "render_client/ui/panels/layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteomill {

namespace {

using Places = std::vector<std::optional<PanelPlace>>;

/// 0 to 1 across the space that the picture leaves to a panel.
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

std::optional<PanelPlace> find_place(const Places& taken, const PanelRequest& request, const glm::vec2& size,
                                     const glm::vec2& picture, float margin) {
    const glm::vec2 room = picture - size - 2.0f * margin;
    if (room.x < 0.0f || room.y < 0.0f) return std::nullopt;
    const glm::vec2 part = part_of(request.anchor);
    PanelPlace place{glm::vec2(margin) + part * room, size, 0};
    const bool upwards = part.y == 1.0f;
    // Every move goes past a panel that it never meets again.
    for (std::size_t moves = 0; moves <= taken.size(); ++moves) {
        const PanelPlace* other = first_met(taken, place, margin);
        if (!other) {
            if (!request.may_cover_middle && meet(place, free_middle(picture), 0.0f)) return std::nullopt;
            return place;
        }
        place.first.y = upwards ? other->first.y - margin - size.y : other->first.y + other->size.y + margin;
        if (place.first.y < margin || place.first.y > margin + room.y) return std::nullopt;
    }
    return std::nullopt;
}

/// With the first so many sizes of each left out.
Places lay_out_from(std::span<const std::size_t> first_choices, std::span<const PanelRequest> requests,
                    const glm::vec2& picture, float margin, const std::optional<PanelPlace>& burr) {
    // The last place is the burr's, for panels that give way to it. Without a burr it is empty.
    Places taken(requests.size() + 1);
    const auto find = [&](const PanelRequest& request, std::size_t choice) {
        taken.back() = request.gives_way ? burr : std::nullopt;
        auto found = find_place(taken, request, request.sizes[choice], picture, margin);
        if (found) found->choice = choice;
        return found;
    };
    for (std::size_t i = 0; i < requests.size(); ++i)
        if (requests[i].is_kept && !requests[i].sizes.empty())
            taken[i] = find(requests[i], requests[i].sizes.size() - 1);
    for (std::size_t i = 0; i < requests.size(); ++i) {
        const std::optional<PanelPlace> kept = std::exchange(taken[i], std::nullopt);
        for (std::size_t choice = first_choices[i]; choice < requests[i].sizes.size() && !taken[i]; ++choice)
            taken[i] = find(requests[i], choice);
        if (!taken[i]) taken[i] = kept;
    }
    taken.pop_back();
    return taken;
}

}  // namespace

Places lay_out(std::span<const PanelRequest> requests, const glm::vec2& picture, float margin,
               const std::optional<PanelPlace>& burr) {
    std::vector<std::size_t> first_choices(requests.size(), 0);
    for (;;) {
        Places places = lay_out_from(first_choices, requests, picture, margin, burr);
        // For a panel without a place, the largest panel that the user opened shrinks, until none can shrink
        // further.
        const bool all_are_there = std::none_of(places.begin(), places.end(), [&](const auto& place) {
            return !place && requests[static_cast<std::size_t>(&place - places.data())].is_requested;
        });
        std::optional<std::size_t> largest;
        const auto area = [&](std::size_t i) { return places[i]->size.x * places[i]->size.y; };
        for (std::size_t i = 0; i < places.size() && !all_are_there; ++i)
            if (places[i] && requests[i].is_requested && places[i]->choice + 1 < requests[i].sizes.size() &&
                (!largest || area(i) > area(*largest)))
                largest = i;
        if (!largest) return places;
        first_choices[*largest] = places[*largest]->choice + 1;
    }
}

std::vector<glm::vec2> shrinking_sizes(const glm::vec2& whole, const glm::vec2& picture, float margin,
                                       float line_height) {
    const float beside_middle = 0.5f * (1.0f - free_middle_part) * picture.x - 2.0f * margin;
    const float narrow = std::min(whole.x, std::max(beside_middle, 1.0f));
    const float line = std::min(line_height, whole.y);
    return {whole,
            {whole.x, 0.7f * whole.y},
            {narrow, whole.y},
            {narrow, 0.6f * whole.y},
            {narrow, 0.35f * whole.y},
            {narrow, line}};
}

std::optional<glm::vec2> free_place(std::span<const glm::vec2> places, const glm::vec2& size,
                                    std::span<const std::optional<PanelPlace>> panels,
                                    const glm::vec2& picture) {
    for (const glm::vec2& first : places) {
        const PanelPlace place{first, size, 0};
        const glm::vec2 end = first + size;
        if (first.x < 0.0f || first.y < 0.0f || end.x > picture.x || end.y > picture.y) continue;
        const bool is_free = std::none_of(panels.begin(), panels.end(), [&](const auto& panel) {
            return panel && meet(*panel, place, 0.0f);
        });
        if (is_free) return first;
    }
    return std::nullopt;
}

float scale_that_fits(float wanted, const glm::vec2& picture) {
    constexpr glm::vec2 smallest_window(500.0f, 400.0f);  // that holds them at the usual size
    const float room = std::min(picture.x / smallest_window.x, picture.y / smallest_window.y);
    // In steps: letters are made anew for each, and a window is pulled larger pixel by pixel.
    return std::min(wanted, std::max(0.25f * std::floor(4.0f * room), 1.0f));
}

}  // namespace osteomill
