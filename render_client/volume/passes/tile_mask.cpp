#include "render_client/volume/passes/tile_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

namespace osteomill {

namespace {

/// Extent along x, so far.
struct Span {
    double low = std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::lowest();

    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

/// Adds the part of the segment from a to b between two heights.
void add_within(Span& span, const glm::dvec2& a, const glm::dvec2& b, double low_y, double high_y) {
    if (std::max(a.y, b.y) < low_y || std::min(a.y, b.y) > high_y) return;
    for (const glm::dvec2& end : {a, b}) {
        const double y = std::clamp(end.y, low_y, high_y);
        const double part = a.y == b.y ? 0.0 : (y - a.y) / (b.y - a.y);
        span.add(a.y == b.y ? end.x : a.x + part * (b.x - a.x));
    }
}

int tile_of(double px, int tiles) {
    // Clamped as a double: points just before the eye lie beyond all integers.
    return static_cast<int>(std::clamp(std::floor(px / tile_edge_px), -1.0, static_cast<double>(tiles)));
}

}  // namespace

TileMask::TileMask(const glm::ivec2& size_px)
    : size_px_(size_px),
      size_tiles_((size_px + (tile_edge_px - 1)) / tile_edge_px),
      marked_(static_cast<std::size_t>(size_tiles_.x) * static_cast<std::size_t>(size_tiles_.y), 0) {}

void TileMask::mark_all() {
    std::fill(marked_.begin(), marked_.end(), std::uint8_t{1});
}

void TileMask::clear() {
    std::fill(marked_.begin(), marked_.end(), std::uint8_t{0});
}

void TileMask::mark(const PixelBox& box) {
    const glm::ivec2 low = glm::clamp(box.first, glm::ivec2(0), size_px_);
    const glm::ivec2 high = glm::clamp(box.first + box.size, glm::ivec2(0), size_px_);
    if (low.x >= high.x || low.y >= high.y) return;
    for (int y = low.y / tile_edge_px; y <= (high.y - 1) / tile_edge_px; ++y) {
        const auto row = marked_.begin() + static_cast<std::ptrdiff_t>(y) * size_tiles_.x;
        std::fill(row + low.x / tile_edge_px, row + (high.x - 1) / tile_edge_px + 1, std::uint8_t{1});
    }
}

void TileMask::mark_hull(std::span<const glm::dvec2> points_px, double margin_px) {
    if (points_px.empty()) return;
    double low_y = points_px[0].y, high_y = low_y;
    for (const glm::dvec2& point : points_px) {
        low_y = std::min(low_y, point.y);
        high_y = std::max(high_y, point.y);
    }
    const int first_row = std::max(tile_of(low_y - margin_px, size_tiles_.y), 0);
    const int last_row = std::min(tile_of(high_y + margin_px, size_tiles_.y), size_tiles_.y - 1);
    for (int row = first_row; row <= last_row; ++row) {
        // A hull's extent within a band is that of the segments between all its points: they include its
        // edges, and none leaves it.
        Span span;
        for (std::size_t a = 0; a < points_px.size(); ++a)
            for (std::size_t b = a; b < points_px.size(); ++b)
                add_within(span, points_px[a], points_px[b], row * tile_edge_px - margin_px,
                           (row + 1) * tile_edge_px + margin_px);
        const int first = std::max(tile_of(span.low - margin_px, size_tiles_.x), 0);
        const int last = std::min(tile_of(span.high + margin_px, size_tiles_.x), size_tiles_.x - 1);
        for (int column = first; column <= last; ++column)
            marked_[static_cast<std::size_t>(row * size_tiles_.x + column)] = 1;
    }
}

TileMask& TileMask::operator|=(const TileMask& other) {
    std::transform(marked_.begin(), marked_.end(), other.marked_.begin(), marked_.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
    return *this;
}

TileMask& TileMask::operator&=(const TileMask& other) {
    std::transform(marked_.begin(), marked_.end(), other.marked_.begin(), marked_.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a & b); });
    return *this;
}

TileMask& TileMask::operator-=(const TileMask& other) {
    std::transform(marked_.begin(), marked_.end(), other.marked_.begin(), marked_.begin(),
                   [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a & ~b); });
    return *this;
}

bool TileMask::any() const {
    return std::find(marked_.begin(), marked_.end(), std::uint8_t{1}) != marked_.end();
}

bool TileMask::contains(const glm::ivec2& pixel) const {
    const glm::ivec2 tile = pixel / tile_edge_px;
    return marked_[static_cast<std::size_t>(tile.y * size_tiles_.x + tile.x)] != 0;
}

std::int64_t TileMask::pixels() const {
    std::int64_t sum = 0;
    for (const std::size_t tile : tiles()) sum += box_of_tile(tile).count();
    return sum;
}

std::vector<std::size_t> TileMask::tiles() const {
    std::vector<std::size_t> marked;
    for (std::size_t tile = 0; tile < marked_.size(); ++tile)
        if (marked_[tile]) marked.push_back(tile);
    return marked;
}

PixelBox TileMask::box_of_tile(std::size_t tile) const {
    const int index = static_cast<int>(tile);
    const glm::ivec2 place(index % size_tiles_.x, index / size_tiles_.x);
    return box_of_tiles(place, place + 1);
}

PixelBox TileMask::box_of_tiles(const glm::ivec2& first, const glm::ivec2& end) const {
    const glm::ivec2 low = first * tile_edge_px;
    return {low, glm::min(end * tile_edge_px, size_px_) - low};
}

std::vector<PixelBox> TileMask::rectangles() const {
    std::vector<PixelBox> joined;
    for (int y = 0; y < size_tiles_.y; ++y) {
        const auto row = marked_.begin() + static_cast<std::ptrdiff_t>(y) * size_tiles_.x;
        for (int x = 0; x < size_tiles_.x; ++x) {
            if (!row[x]) continue;
            const int first = x;
            while (x < size_tiles_.x && row[x]) ++x;
            const PixelBox run = box_of_tiles({first, y}, {x, y + 1});
            const auto below = std::find_if(joined.begin(), joined.end(), [&](const PixelBox& box) {
                return box.first.x == run.first.x && box.size.x == run.size.x &&
                       box.first.y + box.size.y == run.first.y;
            });
            if (below != joined.end())
                below->size.y += run.size.y;
            else
                joined.push_back(run);
        }
    }
    return joined;
}

void mark_box(TileMask& mask, const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& to_clip) {
    std::array<glm::dvec2, 8> corners_px;
    for (std::size_t corner = 0; corner < corners_px.size(); ++corner) {
        const glm::dvec4 clip = to_clip * glm::dvec4(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                                     corner & 4 ? high.z : low.z, 1.0);
        if (clip.z < -clip.w) {
            mask.mark_all();
            return;
        }
        corners_px[corner] = (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(mask.size_px());
    }
    // One more pixel on each side, for rounding in the driver.
    mask.mark_hull(corners_px, 1.0);
}

}  // namespace osteomill
