#include "studies/force/studied_model.h"

#include <utility>

namespace osteomill::study {

namespace {

class VoxelModel final : public StudiedModel {
  public:
    VoxelModel(Bone bone, const Burr& burr, const MillingSettings& settings, bool wants_engagement)
        : model_(std::move(bone), {burr}, {}, settings), wants_engagement_(wants_engagement) {}

    StepOutcome step(const BurrCommand& command) override {
        BurrCommand wanted = command;
        wanted.wants_engagement = wants_engagement_;
        model_.step(wanted, 0.0, changes_, *result_);
        return {result_->force_n, result_->removed_mm3};
    }
    const Bone& bone() const override { return model_.bone(); }

  private:
    MillingModel model_;
    bool wants_engagement_;
    ForgottenChanges changes_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();  // too large for a stack
};

}  // namespace

MakeModel voxel_model(const MillingSettings& settings) {
    return [settings](Bone bone, const Burr& burr) {
        return std::make_unique<VoxelModel>(std::move(bone), burr, settings, false);
    };
}

MakeModel voxel_model_with_engagement() {
    return [](Bone bone, const Burr& burr) {
        return std::make_unique<VoxelModel>(std::move(bone), burr, MillingSettings{}, true);
    };
}

}  // namespace osteomill::study
