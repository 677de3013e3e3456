// The cuts through the bone that a user has set: three along the patient's axes, and one across a view.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "render_client/volume/camera.h"
#include "render_client/volume/scene_appearance.h"

namespace osteomill {

class CutSettings {
  public:
    /// 0 to 2 cut across the patient's x, y, z; this one across the view it was set in.
    static constexpr std::size_t across_view = 3;
    static constexpr std::size_t count = 4;

    struct Cut {
        bool is_on = false;
        glm::dvec3 normal{0.0};    ///< unit, towards the part taken away
        double position_mm = 0.0;  ///< along the normal, from the middle of the bone
        bool is_turned = false;    ///< the other half is gone

        bool operator==(const Cut&) const = default;
    };

    /// The bone's box, patient LPS: where cuts can be. Those that are set stay.
    void set_bounds(const glm::dvec3& low_mm, const glm::dvec3& high_mm);

    /// Across an axis: off, then on so that the half nearer to the eye is gone, then the other half, then
    /// off. Across the view: on, then off. A cut that comes on goes through the bone's middle.
    void step(std::size_t cut, const Camera& camera);
    /// Across an axis (0 to 2): on, whatever it was, with the side of `normal` gone, a unit vector along that
    /// axis. The position counts from the middle; if there are no bounds yet, those that come confine it.
    void set(std::size_t axis, const glm::dvec3& normal, double position_mm);
    void switch_off(std::size_t cut) { cuts_[cut].is_on = false; }
    void turn_over(std::size_t cut);
    /// Within the bone.
    void move_to(std::size_t cut, double position_mm);
    /// Moves the cut that was changed last, if it is on; above zero takes less away.
    void move_last(double outwards_mm);

    const Cut& operator[](std::size_t cut) const { return cuts_[cut]; }
    /// How far a cut may be from the middle, mm.
    double reach_mm(std::size_t cut) const;
    bool any() const;
    /// Those that are on.
    std::vector<CutPlane> planes() const;

  private:
    std::array<Cut, count> cuts_{};
    glm::dvec3 middle_mm_{0.0};
    glm::dvec3 half_mm_{1.0};
    std::size_t last_ = 0;
};

}  // namespace osteomill
