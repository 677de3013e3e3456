// Budget of what is drawn in a frame, so that frames keep their rate: what a pixel costs is learnt from what
// the last ones cost, and from it how many can be afforded and how coarse a picture must be that is drawn
// whole.
//
// A frame has room for `target_frame_s` less what the rest of it takes (tool, panels, showing the picture),
// but at least for a quarter of it. Where nothing moves, a frame may take three times as long, and half of
// that is the least: then nobody sees its rate, but how long the picture stays coarse. What is known follows
// a measurement by half of the difference upwards and by a fifth downwards: a frame that comes late is worse
// than one that is a little coarse. Parts of a picture under a still camera are counted by themselves: they
// are where the bone is, and dearer than the average that background lowers. Before anything was measured a
// pixel counts as dear as a software rasteriser makes it: a first picture that is coarse for a moment is
// better than a second without an answer.
#pragma once

#include <cstdint>

namespace osteomill {

/// What was drawn: a whole picture, or parts of one under a still camera.
enum class Extent { whole, parts };

/// What a picture of another bone, or in another look, takes to draw.
enum class DrawingCost { as_before, unknown };

/// The goal under motion; what is shown then is smooth to the eye.
inline constexpr double target_frame_s = 1.0 / 30.0;

class DetailControl {
  public:
    /// Throws std::invalid_argument unless the time is positive.
    explicit DetailControl(double frame_s = target_frame_s);

    /// Pixels that were drawn and how long it took; nothing is learnt from no pixels or from no time.
    void drew(Extent extent, std::int64_t pixels, double took_s);
    /// How long a whole frame took, waiting excluded, and the drawing of bone in it.
    void frame_took(double frame_s, double drawing_s);

    /// What is drawn from now on costs otherwise.
    void forget_costs();

    /// Pixels for which there is room in a frame.
    std::int64_t affordable_pixels(Extent extent) const;
    /// The same of parts, while neither camera nor bone moves.
    std::int64_t affordable_pixels_at_rest() const;

    /// By how much to divide width and height of so many pixels: 1 for full resolution, up to
    /// 4 for a whole picture and 2 for parts: one that is coarser hides what the hand works at. It falls
    /// only when the finer picture would take at most 80 % of the room, so that it does not flicker between
    /// two.
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
