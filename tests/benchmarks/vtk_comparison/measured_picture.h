// One way of drawing the same bone: ours, VTK's on OpenGL, VTK's on the processor.
#pragma once

#include <memory>
#include <string>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/picture.h"

namespace osteomill {

inline constexpr glm::ivec2 compared_size_px(640, 480);

class MeasuredPicture {
  public:
    virtual ~MeasuredPicture() = default;
    /// From the next draw on.
    virtual void look_from(const Camera& camera) = 0;
    /// These bricks of the bone of the constructor were carved; the next draw shows it.
    virtual void changed(const Bone& bone, std::span<const BrickChange> changes) = 0;
    /// Draws every pixel; returns when the picture is there.
    virtual void draw_all() = 0;
    /// Draws what is due after a change; returns when the picture is there.
    virtual void draw_after_change() = 0;
    virtual Picture picture() = 0;
};

/// `step_voxels` is the distance of samples along a ray, or as the product has it where it is zero.
std::unique_ptr<MeasuredPicture> our_picture(const Bone& bone, float step_voxels);

enum class VtkMapper { gpu, cpu };

/// What VTK is given: all voxels of the grid, as a scan comes, or only the box that holds bone, which is all
/// that we upload.
enum class VtkVolume { whole_grid, cropped };

/// Needs an X display. The fractions as VTK's scalars, an opacity that rises steeply round one half, shaded
/// without highlights by a lamp at the camera, which is VTK's cheapest light.
std::unique_ptr<MeasuredPicture> vtk_picture(const Bone& bone, VtkVolume volume, VtkMapper mapper,
                                             float step_voxels);

}  // namespace osteomill
