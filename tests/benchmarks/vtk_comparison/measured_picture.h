// One way of drawing the same bone: ours, VTK's on OpenGL, VTK's on the processor.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "common/bone/bone.h"
#include "common/bone/brick_change.h"
#include "render_client/volume/camera.h"
#include "render_client/volume/picture.h"

namespace osteomill {

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

/// How a picture is made.
struct PictureSetting {
    glm::ivec2 size_px{640, 480};
    float step_voxels = 0.0f;  ///< distance of samples along a ray; 0: as the product, or the library, has it
    std::optional<int> gpu{};  ///< as of gl::OffscreenContext
};

std::unique_ptr<MeasuredPicture> our_picture(const Bone& bone, const PictureSetting& setting);

enum class VtkMapper { gpu, cpu };

/// What VTK is given: all voxels of the grid, as a scan comes, or only the box that holds bone, which is all
/// that we upload.
enum class VtkVolume { whole_grid, cropped };

/// In an OpenGL context of ours, so on the same device and without a display. The fractions as VTK's scalars,
/// an opacity that rises steeply round one half, shaded without highlights by a lamp at the camera, which is
/// VTK's cheapest light.
std::unique_ptr<MeasuredPicture> vtk_picture(const Bone& bone, VtkVolume volume, VtkMapper mapper,
                                             const PictureSetting& setting);

}  // namespace osteomill
