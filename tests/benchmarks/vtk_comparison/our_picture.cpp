#include "render_client/volume/gl/offscreen_context.h"
#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/scene_picture.h"
#include "tests/benchmarks/vtk_comparison/measured_picture.h"

namespace osteomill {

namespace {

RaycastSettings settings_with(float step_voxels) {
    RaycastSettings settings;
    if (step_voxels > 0.0f) settings.step_voxels = step_voxels;
    return settings;
}

class OurPicture final : public MeasuredPicture {
  public:
    OurPicture(const Bone& bone, const PictureSetting& setting)
        : context_(setting.gpu),
          textures_(bone, {}),
          renderer_(settings_with(setting.step_voxels)),
          scene_(renderer_, setting.size_px) {}

    void look_from(const Camera& camera) override { camera_ = camera; }
    void changed(const Bone& bone, std::span<const BrickChange> changes) override {
        scene_.mark_dirty(textures_, textures_.update(bone, changes));
    }
    void draw_all() override {
        scene_.forget_bone();
        draw_after_change();
    }
    void draw_after_change() override {
        // A pixel that is read has been drawn, and all others with it.
        scene_.draw(&textures_, nullptr, camera_).depth_at({0, 0});
    }
    Picture picture() override { return scene_.draw(&textures_, nullptr, camera_).read_back(); }

  private:
    gl::OffscreenContext context_;
    BoneTextures textures_;
    RaycastRenderer renderer_;
    ScenePicture scene_;
    Camera camera_;
};

}  // namespace

std::unique_ptr<MeasuredPicture> our_picture(const Bone& bone, const PictureSetting& setting) {
    return std::make_unique<OurPicture>(bone, setting);
}

}  // namespace osteomill
