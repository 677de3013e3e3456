// The three slices through the CT that cross at one point: the point, the slices' display, and their pictures
// on the graphics card.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/bone/bone.h"
#include "common/bone/ct_volume.h"
#include "common/scene/scene.h"
#include "render_client/volume/ct_slice.h"
#include "render_client/volume/gl/texture.h"

namespace osteomill {

/// A slice's picture, and its sources.
struct DrawnSlice {
    gl::Texture2D texture;
    SliceView view;
    HuWindow window;
    const CtVolume* ct = nullptr;
    std::uint64_t bone_version = 0;
};

class SlicesView {
  public:
    static constexpr std::array<SlicePlane, 3> planes{SlicePlane::axial, SlicePlane::coronal,
                                                      SlicePlane::sagittal};

    /// A CT has come. The slices first cross in its middle, unless cross_at() has said where.
    void set_ct(std::shared_ptr<const CtVolume> ct);
    const std::shared_ptr<const CtVolume>& ct() const { return ct_; }

    /// Tissues whose borders are drawn, in this order: those of the session with voxels in the bone.
    void set_tissues(std::span<const Tissue> tissues);
    /// One of them lies here, whether bone is there or not.
    void set_mask(std::size_t tissue, const StructureMask& mask);

    /// Patient LPS; kept within the CT, once that is there.
    void cross_at(const glm::dvec3& position_mm);
    const std::optional<glm::dvec3>& cross_mm() const { return cross_mm_; }
    /// Towards the cross, which then is in the middle.
    void zoom(double factor);
    HuWindow& window() { return window_; }

    /// The slice's picture as it is now, made anew only if something has changed. `bone_version` goes up with
    /// each change of the bone.
    const gl::Texture2D& picture(SlicePlane plane, int edge_px, const Bone* bone, std::uint64_t bone_version);
    SliceView view(SlicePlane plane, int edge_px) const;

  private:
    std::shared_ptr<const CtVolume> ct_;
    std::optional<glm::dvec3> cross_mm_;
    glm::dvec3 centre_mm_{0.0};  // the pictures' centre, but for the coordinate across their planes
    double width_mm_ = 30.0;
    HuWindow window_;
    std::vector<SliceTissue> tissues_;
    std::array<std::optional<DrawnSlice>, 3> drawn_;
};

}  // namespace osteomill
