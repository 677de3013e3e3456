// Budget of drawing in a frame, for a steady frame rate. The cost of a pixel is learnt from the last frames.
// It gives the number of pixels that a frame can afford, and the resolution of a whole picture. Drawing may
// take `target_frame_s` less the time of the frame's other parts (tool, panels, display), but at least a
// quarter of it. While nothing moves, a frame may take three times as long, and drawing gets at least half of
// that: the frame rate is then invisible, but not the time until the picture is fine. The estimate follows a
// measurement by half of the difference upwards and by a fifth downwards, because a late frame is worse than
// a slightly coarse one. Parts of a picture under a still camera are counted separately: they contain bone,
// and cost more than the average with background. Before any measurement a pixel counts as expensive as in a
// software rasteriser: a first picture that is coarse for a moment is better than a second without an answer.
#pragma once

#include <cstdint>

namespace osteomill {

/// Extent of a drawing: a whole picture, or parts of one under a still camera.
enum class Extent { whole, parts };

/// Cost of drawing after a change of bone or appearance.
enum class DrawingCost { as_before, unknown };

/// The goal under motion: a rate that is smooth to the eye.
inline constexpr double target_frame_s = 1.0 / 30.0;

class DetailControl {
  public:
    /// Throws std::invalid_argument unless the time is positive.
    explicit DetailControl(double frame_s = target_frame_s);

    /// Learns from the drawn pixels and their time; no pixels or no time teach nothing.
    void drew(Extent extent, std::int64_t pixels, double took_s);
    /// Learns the time of a whole frame, waiting excluded, and of the drawing of bone in it.
    void frame_took(double frame_s, double drawing_s);

    /// Forgets the cost: drawings from now on cost otherwise.
    void forget_costs();

    /// Pixels that a frame can afford.
    std::int64_t affordable_pixels(Extent extent) const;
    /// Pixels of parts that a frame can afford while neither camera nor bone moves.
    std::int64_t affordable_pixels_at_rest() const;

    /// Divisor of width and height for so many pixels: 1 for full resolution, up to 4 for a whole picture and
    /// 2 for parts, since coarser parts would hide the place where the hand works. It falls only when the
    /// finer picture would take at most 80 % of the time, so that it does not flicker between two values.
    double divisor_for(Extent extent, std::int64_t pixels);

  private:
    struct Known {
        double s_per_px = 0.0;  ///< zero: nothing was measured yet
        double divisor = 1.0;
    };

    std::int64_t pixels_in(Extent extent, double room_s) const;

    double frame_s_;
    double rest_s_ = 0.0;
    Known whole_;
    Known parts_;
};

}  // namespace osteomill
