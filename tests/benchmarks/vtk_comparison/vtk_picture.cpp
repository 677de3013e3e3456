#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkGPUVolumeRayCastMapper.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtk_glew.h>

#include <algorithm>
#include <glm/trigonometric.hpp>
#include <stdexcept>

#include "render_client/volume/gl/offscreen_context.h"
#include "render_client/volume/textures/voxel_box.h"
#include "tests/benchmarks/vtk_comparison/measured_picture.h"

namespace osteomill {

namespace {

/// Fractions at which bone begins to be seen and is opaque within a voxel: one half, as we draw it, as a
/// ramp.
constexpr double clear_code = 0.4 * 255.0;
constexpr double opaque_code = 0.6 * 255.0;
constexpr double one_voxel = 1.0;

/// A window of VTK's that draws in whichever OpenGL context is current. VTK 9.1 takes GLEW's word that there
/// is no OpenGL where there is no X display, although GLEW has found all of its functions by then.
class WindowInOurContext final : public vtkGenericOpenGLRenderWindow {
  public:
    static WindowInOurContext* New() { VTK_STANDARD_NEW_BODY(WindowInOurContext); }

    void OpenGLInitContext() override {
        ContextCreationTime.Modified();
        if (Initialized) return;
        const GLenum result = glewInit();
        GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
        if (!GlewInitValid) throw std::runtime_error("VTK finds no OpenGL in our context");
        Initialized = true;
    }

  private:
    WindowInOurContext() {
        SetIsDirect(1);
        SetSupportsOpenGL(1);
        SetIsCurrent(true);
        SetReadyForRendering(true);
        SetFrameBlitModeToNoBlit();  // a context without a surface has nothing to show it on
    }
};

vtkSmartPointer<vtkImageData> image_of(const Bone& bone, const VoxelBox& box) {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(box.size.x, box.size.y, box.size.z);
    const double spacing_mm = bone.grid().spacing_mm;
    image->SetSpacing(spacing_mm, spacing_mm, spacing_mm);
    const glm::dvec3 origin_mm = centre_of_voxel_mm(bone.grid(), box.first);
    image->SetOrigin(origin_mm.x, origin_mm.y, origin_mm.z);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
    copy_channel(bone, BoneChannel::fraction, box,
                 {static_cast<std::uint8_t*>(image->GetScalarPointer()), box.count()});
    return image;
}

vtkSmartPointer<vtkVolumeMapper> make_mapper(VtkMapper kind, double step_mm) {
    if (kind == VtkMapper::cpu) {
        auto mapper = vtkSmartPointer<vtkFixedPointVolumeRayCastMapper>::New();
        mapper->AutoAdjustSampleDistancesOff();
        mapper->SetImageSampleDistance(1.0f);
        mapper->SetSampleDistance(static_cast<float>(step_mm));
        mapper->SetInteractiveSampleDistance(static_cast<float>(step_mm));
        return mapper;
    }
    auto mapper = vtkSmartPointer<vtkGPUVolumeRayCastMapper>::New();
    mapper->AutoAdjustSampleDistancesOff();
    mapper->SetImageSampleDistance(1.0f);
    mapper->SetSampleDistance(static_cast<float>(step_mm));
    return mapper;
}

class VtkPicture final : public MeasuredPicture {
  public:
    VtkPicture(const Bone& bone, VtkVolume extent, VtkMapper kind, const PictureSetting& setting)
        : context_(setting.gpu),
          size_px_(setting.size_px),
          box_(extent == VtkVolume::cropped ? stored_box(bone.content())
                                            : VoxelBox{{}, bone.grid().size_voxels}),
          image_(image_of(bone, box_)),
          mapper_(make_mapper(
              kind, (setting.step_voxels > 0.0f ? static_cast<double>(setting.step_voxels) : one_voxel) *
                        bone.grid().spacing_mm)) {
        mapper_->SetInputData(image_);
        vtkNew<vtkPiecewiseFunction> opacity;
        opacity->AddPoint(clear_code, 0.0);
        opacity->AddPoint(opaque_code, 1.0);
        vtkNew<vtkColorTransferFunction> colour;
        colour->AddRGBPoint(0.0, 0.93, 0.85, 0.72);
        vtkNew<vtkVolumeProperty> property;
        property->SetScalarOpacity(opacity);
        property->SetScalarOpacityUnitDistance(bone.grid().spacing_mm);
        property->SetColor(colour);
        property->SetInterpolationTypeToLinear();
        property->ShadeOn();
        property->SetAmbient(0.25);
        property->SetDiffuse(0.75);
        property->SetSpecular(0.0);
        vtkNew<vtkVolume> volume;
        volume->SetMapper(mapper_);
        volume->SetProperty(property);
        renderer_->AddVolume(volume);
        window_->SetOffScreenRendering(1);
        window_->SetMultiSamples(0);
        window_->SetSize(size_px_.x, size_px_.y);
        window_->AddRenderer(renderer_);
    }

    void look_from(const Camera& camera) override {
        const glm::dvec3 eye = camera.eye_mm(), up = camera.up();
        vtkCamera* shown = renderer_->GetActiveCamera();
        shown->SetPosition(eye.x, eye.y, eye.z);
        shown->SetFocalPoint(camera.target_mm.x, camera.target_mm.y, camera.target_mm.z);
        shown->SetViewUp(up.x, up.y, up.z);
        shown->SetViewAngle(glm::degrees(camera.field_of_view_rad));
        renderer_->ResetCameraClippingRange();
    }
    void changed(const Bone& bone, std::span<const BrickChange> changes) override {
        for (const BrickChange& change : changes) {
            const glm::ivec3 brick = brick_position(bone.content().size_bricks, change.brick);
            const auto fractions = bone.fractions(bone.slot(brick));
            const glm::ivec3 first = brick * brick_edge_voxels - box_.first;
            for (int row = 0; row < brick_edge_voxels * brick_edge_voxels; ++row)
                std::copy_n(
                    fractions.begin() + row * brick_edge_voxels, brick_edge_voxels,
                    static_cast<std::uint8_t*>(image_->GetScalarPointer(
                        first.x, first.y + row % brick_edge_voxels, first.z + row / brick_edge_voxels)));
        }
        image_->GetPointData()->GetScalars()->Modified();
        image_->Modified();
    }
    void draw_all() override {
        window_->Render();
        window_->WaitForCompletion();
    }
    void draw_after_change() override { draw_all(); }
    Picture picture() override {
        Picture picture(size_px_);
        vtkNew<vtkUnsignedCharArray> pixels;
        window_->GetPixelData(0, 0, size_px_.x - 1, size_px_.y - 1, 0, pixels, 0);
        const std::size_t row_bytes = 3u * size_px_.x;
        for (std::size_t row = 0; row < static_cast<std::size_t>(size_px_.y); ++row)
            std::copy_n(pixels->GetPointer(0) + (static_cast<std::size_t>(size_px_.y) - 1 - row) * row_bytes,
                        row_bytes, picture.rgb.begin() + static_cast<std::ptrdiff_t>(row * row_bytes));
        return picture;
    }

  private:
    gl::OffscreenContext context_;
    glm::ivec2 size_px_;
    VoxelBox box_;
    vtkSmartPointer<vtkImageData> image_;
    vtkSmartPointer<vtkVolumeMapper> mapper_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<WindowInOurContext> window_;
};

}  // namespace

std::unique_ptr<MeasuredPicture> vtk_picture(const Bone& bone, VtkVolume volume, VtkMapper mapper,
                                             const PictureSetting& setting) {
    return std::make_unique<VtkPicture>(bone, volume, mapper, setting);
}

}  // namespace osteomill
