// A set of square tiles of a picture, such as those that show a change, or those that the tool covers. A
// union of any regions costs no more than its tiles, however far apart they lie.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "render_client/volume/camera.h"

namespace osteomill {

/// A software rasteriser works in blocks of this size anyway; smaller tiles would only mean more draw calls.
inline constexpr int tile_edge_px = 16;

class TileMask {
  public:
    /// No tile is marked. The last row and column of tiles end where the picture does.
    explicit TileMask(const glm::ivec2& size_px);

    void mark_all();
    void clear();
    /// Every tile that the box touches; parts outside the picture are ignored.
    void mark(const PixelBox& box);
    /// Every tile that comes within `margin_px` (in x and in y) of the convex hull of these points; pixels,
    /// y up.
    void mark_hull(std::span<const glm::dvec2> points_px, double margin_px);

    TileMask& operator|=(const TileMask& other);  ///< of the same size, as the two below
    TileMask& operator&=(const TileMask& other);
    TileMask& operator-=(const TileMask& other);
    bool operator==(const TileMask&) const = default;

    bool any() const;
    bool contains(const glm::ivec2& pixel) const;
    /// Pixels of all marked tiles.
    std::int64_t pixels() const;
    /// Marked tiles in the order of rows from the bottom, and the pixels that one covers.
    std::vector<std::size_t> tiles() const;
    PixelBox box_of_tile(std::size_t tile) const;
    /// The marked tiles as rectangles that do not overlap: runs of a row, joined with equal ones above.
    std::vector<PixelBox> rectangles() const;

    const glm::ivec2& size_px() const { return size_px_; }

  private:
    PixelBox box_of_tiles(const glm::ivec2& first, const glm::ivec2& end) const;

    glm::ivec2 size_px_;
    glm::ivec2 size_tiles_;
    std::vector<std::uint8_t> marked_;
};

/// Marks every tile that can show a box, given by its opposite corners and a matrix to OpenGL's clip space,
/// and a pixel round it. Marks all tiles if the box reaches behind the eye and could be anywhere.
void mark_box(TileMask& mask, const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& to_clip);

}  // namespace osteomill
