// The drawn bone: its textures, made and kept up to date in small steps, so that a picture never waits long
// for them. While the textures of another bone or appearance are made, the previous ones are still drawn, if
// both fit the allowed memory.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/bone/brick_change.h"
#include "render_client/volume/passes/detail_control.h"
#include "render_client/volume/textures/bone_textures.h"

namespace osteomill {

class BoneOnScreen {
  public:
    explicit BoneOnScreen(ShadingSettings look) : look_(std::move(look)) {}

    struct Outcome {
        bool other_textures = false;              ///< or none any more: all is to be drawn anew
        DrawingCost cost = DrawingCost::unknown;  ///< cost of a picture of them
        std::vector<VoxelBox> changed{};          ///< else: voxels of textures()->grid()
        bool is_news() const { return other_textures || !changed.empty(); }
    };

    /// Limits the textures of bones that come from now on.
    void limit(const TextureLimits& limits) { limits_ = limits; }
    /// Makes large textures' memory from now on; must outlive this, as the driver's context must.
    void make_storage_by(gl::StorageThread& thread) { storage_ = &thread; }

    /// Another bone has come: it is prepared by work(). `tissues` as they are drawn.
    void replace(const Bone& bone, std::vector<TissueColour> tissues);
    /// Marks the drawn bone as a former session's; the new session's has not come yet.
    void expect_another() {
        if (shown_) shown_->is_of_former_bone = true;
    }
    bool shows_former_bone() const { return shown_ && shown_->is_of_former_bone; }
    /// Nothing is drawn until that of now is ready.
    Outcome drop_former_bone();
    /// A soft structure of that bone, with a tissue's label: thin bone shows it.
    void add_structure(std::uint8_t label, const StructureMask& structure);
    /// It changed there.
    void note(std::span<const BrickChange> changes);
    /// A new appearance needs new textures. Those for an earlier one are finished first, so that a user who
    /// drags a curve sees intermediate results.
    void set_appearance(const ShadingSettings& look) { look_ = look; }
    const ShadingSettings& look() const { return look_; }

    /// Prepares textures and uploads changes until nothing is left to do or the time is over; at least one
    /// step. `bone` is the one that replace() had last, at the same address.
    Outcome work(const Bone& bone, const std::function<bool()>& has_time);

    /// Null until the first are complete, and if the memory does not hold them beside those to come.
    const BoneTextures* textures() const { return shown_ ? &shown_->textures : nullptr; }
    /// How much of the preparation is done, 0 to 1, while one goes on.
    std::optional<double> preparation() const;
    /// Why the bone that came last cannot be drawn; empty while it can.
    const std::string& problem() const { return problem_; }

  private:
    struct Shown {
        BoneTextures textures;
        ShadingSettings look;
        bool is_of_former_bone = false;  ///< another has come since
    };
    void begin(const Bone& bone);
    void build(const Bone& bone, const std::function<bool()>& has_time, Outcome& outcome);
    /// Drops the shown textures if they are in the way. True: the build began anew.
    bool make_room(const Bone& bone, Outcome& outcome);
    void show(Outcome& outcome);
    void fail(const std::string& problem, Outcome& outcome);
    void drop_shown(Outcome& outcome);
    void drop(std::shared_ptr<void> unused);

    ShadingSettings look_;
    TextureLimits limits_;
    gl::StorageThread* storage_ = nullptr;
    std::vector<TissueColour> tissues_;
    std::vector<std::pair<std::uint8_t, StructureMask>> structures_;
    std::shared_ptr<Shown> shown_;
    GatheredChanges unshown_;
    std::shared_ptr<TextureBuild> build_;
    ShadingSettings build_look_;
    GatheredChanges unbuilt_;  ///< changes during the build
    std::string problem_;
};

}  // namespace osteomill
