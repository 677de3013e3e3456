#include "render_client/ui/view/bone_on_screen.h"

#include <stdexcept>
#include <utility>

namespace osteomill {

namespace {

/// Uploaded in one step: a burr changes fewer between two frames, an undo may change thousands.
constexpr std::size_t bricks_a_step = 64;

}  // namespace

void BoneOnScreen::replace(const Bone& bone, std::vector<TissueColour> tissues) {
    tissues_ = std::move(tissues);
    structures_.clear();
    unshown_.clear();
    if (shown_) shown_->is_of_former_bone = true;
    begin(bone);
}

BoneOnScreen::Outcome BoneOnScreen::drop_former_bone() {
    Outcome outcome;
    if (shows_former_bone()) drop_shown(outcome);
    return outcome;
}

void BoneOnScreen::add_structure(std::uint8_t label, const StructureMask& structure) {
    structures_.emplace_back(label, structure);
    if (shown_ && !shown_->is_of_former_bone) shown_->textures.add_structure(label, structure);
}

void BoneOnScreen::note(std::span<const BrickChange> changes) {
    if (shown_ && !shown_->is_of_former_bone) unshown_.add(changes);
    if (build_) unbuilt_.add(changes);
}

void BoneOnScreen::begin(const Bone& bone) {
    if (build_) drop(std::exchange(build_, nullptr));
    problem_.clear();
    unbuilt_.clear();
    build_look_ = look_;
    build_ = std::make_shared<TextureBuild>(bone, tissues_, look_, limits_, storage_);
}

BoneOnScreen::Outcome BoneOnScreen::work(const Bone& bone, const std::function<bool()>& has_time) {
    Outcome outcome;
    // If nothing is shown yet, the appearance has failed before and would fail again and again.
    if (!build_ && shown_ && shown_->look != look_) begin(bone);
    if (build_) build(bone, has_time, outcome);
    while (!unshown_.empty()) {
        const auto changed = shown_->textures.update(bone, unshown_.take(bricks_a_step));
        outcome.changed.insert(outcome.changed.end(), changed.begin(), changed.end());
        if (!has_time()) break;
    }
    while (shown_ && !shown_->is_of_former_bone && has_time()) {
        const auto changed = shown_->textures.work(bone);
        if (changed.empty()) break;
        outcome.changed.insert(outcome.changed.end(), changed.begin(), changed.end());
    }
    return outcome;
}

void BoneOnScreen::build(const Bone& bone, const std::function<bool()>& has_time, Outcome& outcome) {
    try {
        do {
            const bool goes_on = build_->step();
            if (make_room(bone, outcome) || goes_on) continue;
            show(outcome);
            if (shown_->look == look_) return;
            begin(bone);
        } while (has_time());
    } catch (const std::runtime_error& error) {
        fail(error.what(), outcome);
    }
}

bool BoneOnScreen::make_room(const Bone& bone, Outcome& outcome) {
    if (!shown_ || !build_->plan()) return false;
    const bool fits = shown_->textures.plan().bytes + build_->plan()->bytes <= limits_.budget_bytes;
    const bool has_settled_for_less = build_->has_settled_for_less();
    if (fits && !has_settled_for_less) return false;
    drop_shown(outcome);
    // Without those before, the driver may have memory for better ones.
    if (has_settled_for_less) begin(bone);
    return has_settled_for_less;
}

void BoneOnScreen::show(Outcome& outcome) {
    const std::shared_ptr<Shown> made = std::make_shared<Shown>(Shown{build_->take(), build_look_});
    build_.reset();
    // While a curve is dragged, a picture is as dear as the one before and need not turn coarse.
    const bool costs_as_before = shown_ && !shown_->is_of_former_bone &&
                                 shown_->textures.is_translucent() == made->textures.is_translucent();
    if (shown_) drop_shown(outcome);
    shown_ = made;
    for (const auto& [label, structure] : structures_) shown_->textures.add_structure(label, structure);
    outcome.cost = costs_as_before ? DrawingCost::as_before : DrawingCost::unknown;
    unshown_ = std::exchange(unbuilt_, {});
    outcome.other_textures = true;
}

void BoneOnScreen::fail(const std::string& problem, Outcome& outcome) {
    problem_ = problem;
    drop(std::exchange(build_, nullptr));
    if (shown_) drop_shown(outcome);
    outcome.other_textures = true;
}

void BoneOnScreen::drop_shown(Outcome& outcome) {
    // A texture that a context has bound lives on, even if another context deletes it.
    gl::Texture3D::unbind_all();
    drop(std::exchange(shown_, nullptr));
    unshown_.clear();
    outcome.other_textures = true;
}

void BoneOnScreen::drop(std::shared_ptr<void> unused) {
    if (storage_ != nullptr) storage_->discard(std::move(unused));
}

std::optional<double> BoneOnScreen::preparation() const {
    if (!build_) return std::nullopt;
    return build_->done();
}

}  // namespace osteomill
