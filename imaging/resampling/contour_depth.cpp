#include "imaging/resampling/contour_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace osteomill {

namespace {

struct Piece {
    glm::vec2 from_mm{0.0F};
    glm::vec2 to_mm{0.0F};
};

float squared_distance_mm2(const glm::vec2& place_mm, const Piece& piece) {
    const glm::vec2 along = piece.to_mm - piece.from_mm;
    const glm::vec2 towards = place_mm - piece.from_mm;
    const float length2 = glm::dot(along, along);
    const float share = length2 > 0.0F ? std::clamp(glm::dot(towards, along) / length2, 0.0F, 1.0F) : 0.0F;
    const glm::vec2 away = towards - share * along;
    return glm::dot(away, away);
}

/// Each pixel learns which piece of the contour is nearest: first those beside the contour, then from its
/// neighbours, as they do. P. Danielsson, "Euclidean distance mapping", Computer Graphics and Image
/// Processing 14, 1980; here of pieces of lines rather than of pixels.
class NearestPieces {
  public:
    NearestPieces(const SlicePixels& slice, double threshold_hu, double reach_mm)
        : slice_(slice),
          threshold_hu_(static_cast<float>(threshold_hu)),
          nearest_(slice.hu.size(), none),
          distance_mm2_(slice.hu.size(), static_cast<float>(reach_mm * reach_mm)) {
        for (int row = 0; row + 1 < slice.rows; ++row)
            for (int column = 0; column + 1 < slice.columns; ++column) add_contour_of_cell(column, row);
        if (!pieces_.empty()) spread();
    }

    float distance_mm(std::size_t pixel) const { return std::sqrt(distance_mm2_[pixel]); }

  private:
    static constexpr int none = -1;

    std::size_t index(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(slice_.columns) +
               static_cast<std::size_t>(column);
    }
    glm::vec2 place_mm(int column, int row) const {
        return {static_cast<float>(column * slice_.column_mm), static_cast<float>(row * slice_.row_mm)};
    }
    bool in_bone(float hu) const { return hu >= threshold_hu_; }

    /// The contour between four pixels (marching squares): none, one piece, or two where bone meets in a
    /// corner; whether it does there, their mean says.
    void add_contour_of_cell(int column, int row) {
        const std::array<glm::ivec2, 4> corner{glm::ivec2(column, row), glm::ivec2(column + 1, row),
                                               glm::ivec2(column + 1, row + 1), glm::ivec2(column, row + 1)};
        std::array<float, 4> hu{};
        for (std::size_t i = 0; i < 4; ++i) hu[i] = slice_.hu[index(corner[i].x, corner[i].y)];
        std::array<glm::vec2, 4> crossing{};
        std::size_t crossings = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::size_t next = (i + 1) % 4;
            if (in_bone(hu[i]) == in_bone(hu[next])) continue;
            const float share = (threshold_hu_ - hu[i]) / (hu[next] - hu[i]);
            const glm::vec2 from = place_mm(corner[i].x, corner[i].y);
            crossing[crossings++] = from + share * (place_mm(corner[next].x, corner[next].y) - from);
        }
        if (crossings == 2) add({crossing[0], crossing[1]}, corner);
        if (crossings != 4) return;
        const bool joins_first = in_bone(hu[0]) == in_bone(0.25F * (hu[0] + hu[1] + hu[2] + hu[3]));
        const std::size_t shift = joins_first ? 0 : 1;
        add({crossing[shift], crossing[shift + 1]}, corner);
        add({crossing[shift + 2], crossing[(shift + 3) % 4]}, corner);
    }

    void add(const Piece& piece, const std::array<glm::ivec2, 4>& corners) {
        pieces_.push_back(piece);
        for (const glm::ivec2& corner : corners)
            offer(static_cast<int>(pieces_.size()) - 1, corner.x, corner.y);
    }

    void offer(int piece, int column, int row) {
        const std::size_t pixel = index(column, row);
        if (piece == none || piece == nearest_[pixel]) return;
        const float distance_mm2 =
            squared_distance_mm2(place_mm(column, row), pieces_[static_cast<std::size_t>(piece)]);
        if (distance_mm2 >= distance_mm2_[pixel]) return;
        distance_mm2_[pixel] = distance_mm2;
        nearest_[pixel] = piece;
    }

    void ask(int column, int row, int other_column, int other_row) {
        if (other_column < 0 || other_column >= slice_.columns || other_row < 0 || other_row >= slice_.rows)
            return;
        offer(nearest_[index(other_column, other_row)], column, row);
    }

    void spread() {
        for (int row = 0; row < slice_.rows; ++row) spread_into(row, row - 1);
        for (int row = slice_.rows - 1; row >= 0; --row) spread_into(row, row + 1);
    }
    void spread_into(int row, int from_row) {
        for (int column = 0; column < slice_.columns; ++column) {
            for (int beside = -1; beside <= 1; ++beside) ask(column, row, column + beside, from_row);
            ask(column, row, column - 1, row);
        }
        for (int column = slice_.columns - 1; column >= 0; --column) ask(column, row, column + 1, row);
    }

    const SlicePixels& slice_;
    float threshold_hu_;
    std::vector<Piece> pieces_{};
    std::vector<int> nearest_;  // index of the piece
    std::vector<float> distance_mm2_;
};

}  // namespace

void contour_depth_mm(const SlicePixels& slice, double threshold_hu, double reach_mm,
                      std::span<float> depth_mm) {
    const NearestPieces pieces(slice, threshold_hu, reach_mm);
    for (std::size_t pixel = 0; pixel < depth_mm.size(); ++pixel)
        depth_mm[pixel] = slice.hu[pixel] >= static_cast<float>(threshold_hu) ? pieces.distance_mm(pixel)
                                                                              : -pieces.distance_mm(pixel);
}

}  // namespace osteomill
