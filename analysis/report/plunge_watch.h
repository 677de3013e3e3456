// Watch for breakthroughs: the burr's tip leaves bone through its far side, and plunges beyond.
//
// At each state with the spindle on, the watch looks for bone ahead of the tip, along the spindle, up to 3
// mm. Bone with 1 mm free behind it ends in a far wall, found to half a voxel. The burr breaks through when
// its tip passes the far wall's plane, square to the spindle, within a radius of that place and at most 0.25
// s after bone was ahead, while bone is cut. The plunge is the farthest that the tip is beyond the plane in
// the next 100 ms. Sideways milling breaks through nothing: the tip does not lead.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/scene/burr.h"

namespace osteomill {

struct Breakthrough {
    double time_s = 0.0;     ///< session time
    double plunge_mm = 0.0;  ///< beyond the far wall, in plunge_window_s
};

inline constexpr double plunge_window_s = 0.1;

/// The tool's place at a tick, or at a state if a recording has no ticks. Patient LPS.
struct ToolMoment {
    double time_s = 0.0;
    glm::dvec3 burr_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit, from tip to shank
    double radius_mm = 0.0;                  ///< half of the head's diameter: the tip lies as far below
    bool spindle_on = false;
};

class PlungeWatch {
  public:
    /// The next state. `bone`: as it is there. `moments`: since the state before, the last of them this
    /// one's. `cuts`: bone was milled in between.
    void update(const Bone& bone, std::span<const ToolMoment> moments, bool cuts);
    /// The tool was put elsewhere, or the session stood still: the wall ahead is forgotten.
    void forget();

    /// In the order of their time. A plunge of the last 100 ms may not be at its end.
    const std::vector<Breakthrough>& breakthroughs() const { return breakthroughs_; }

  private:
    struct FarWall {
        glm::dvec3 place_mm;
        glm::dvec3 inwards;  ///< unit, along which the tip comes
        double seen_s;
    };
    static std::optional<FarWall> far_wall(const Bone& bone, const ToolMoment& from);
    /// The wall ahead before the `next` one: of its last voxel less than half is left, so it is not seen.
    bool is_about_to_pass(const FarWall& next, double voxel_mm) const;
    void follow(const ToolMoment& from, const ToolMoment& to, bool cuts);

    std::optional<ToolMoment> last_;
    std::optional<FarWall> ahead_;
    std::optional<FarWall> behind_;  // of the last breakthrough, while its plunge is measured
    std::vector<Breakthrough> breakthroughs_;
};

/// Number of times that the burr broke through bone, and how far it plunged.
struct PlungeMetrics {
    std::size_t breakthroughs = 0;
    std::optional<double> mean_mm{};  ///< nothing: no breakthrough
    std::optional<double> most_mm{};
};

PlungeMetrics plunge_metrics(std::span<const Breakthrough> breakthroughs);

}  // namespace osteomill
