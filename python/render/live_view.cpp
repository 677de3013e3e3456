#include "python/render/live_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "common/wire/scene_messages.h"
#include "haptic_server/streaming/live_session.h"
#include "imaging/case/structures.h"
#include "python/render/current_context.h"
#include "render_client/dataset/dataset_frames.h"
#include "render_client/dataset/dataset_index.h"

namespace osteomill::python {

namespace {

DatasetContents checked(DatasetContents contents) {
    for (const DatasetCamera& camera : contents.cameras)
        if (camera.follows_trainee)
            throw std::invalid_argument(fmt::format(
                "cameras: nobody looks at a session in Python, so that \"{}\" has nobody to follow; give it "
                "eye_mm and target_mm",
                camera.name));
    return contents;
}

/// The value after its way through a message, as into a recording and out of it.
template <typename Value>
Value received(std::variant<Value, WireError> message) {
    if (const auto* error = std::get_if<WireError>(&message)) throw std::runtime_error(error->line);
    return std::get<Value>(std::move(message));
}

SessionInfo info_of(const SteppedSession& stepped) {
    SessionInfo info =
        session_info(stepped.loaded().settings(), false, stepped.max_force_n(), OSTEOMILL_VERSION);
    info.case_name = stepped.loaded().name();
    return received(session_info_from(to_message(info)));
}

ToolState tool_of(const SteppedSession& stepped, const SessionInfo& info) {
    return received(tool_from(to_message(stepped.tool()), info.burrs.size()));
}

/// Coefficients are not seen.
bool looks_alike(const Burr& one, Burr other) {
    other.cutting_coefficients_n_per_mm2 = one.cutting_coefficients_n_per_mm2;
    other.edge_coefficients_n_per_mm = one.edge_coefficients_n_per_mm;
    return one == other;
}

std::vector<Structure> structures_of(const SteppedSession& stepped) {
    const SessionScene& scene = stepped.loaded().scene();
    return structures_outside_bone_labels(scene.structures, scene.scene, stepped.bone());
}

}  // namespace

LiveView::LiveView(const SteppedSession& session, DatasetContents contents)
    : contents_(checked(std::move(contents))), session_(session), json_(session_json(session_)) {
    const CurrentContext current(context_);
    gl::require_opengl_3_3();
    images_.emplace(session_, contents_.cameras, contents_.look, contents_.limits);
}

LiveView::~LiveView() {
    const CurrentContext current(context_);
    images_.reset();
}

Rendering::Frame LiveView::draw(const SteppedSession& session) {
    const std::scoped_lock held(busy_);
    session_.go_to(session);
    const CurrentContext current(context_);
    images_->follow();
    Rendering::Frame frame{
        .drawn = draw_frame(*images_, contents_, count_++, session_), .instant = {}, .views = {}};
    frame.instant = instant_json(frame.drawn, session_);
    for (std::size_t i = 0; i < frame.drawn.images.size(); ++i)
        frame.views.push_back(view_json(frame.drawn, i, cameras()[i]));
    return frame;
}

DrawnLiveSession::DrawnLiveSession(const SteppedSession& session)
    : stepped_(&session),
      case_(session.shared_case()),
      info_(info_of(*stepped_)),
      structures_(structures_of(*stepped_)),
      tool_(tool_of(*stepped_, info_)),
      seen_(stepped_->bone()) {}

void DrawnLiveSession::go_to(const SteppedSession& session) {
    const Scene& here = case_->settings();
    const Scene& there = session.loaded().settings();
    if (session.bone().shared_content() != seen_.shared_content() || there.tissues != here.tissues ||
        !std::ranges::equal(there.burrs, here.burrs, looks_alike))
        throw std::invalid_argument(
            "session: is of another bone, other tissues or other burrs than the view; make another view");
    stepped_ = &session;
    tool_ = tool_of(*stepped_, info_);
}

std::vector<BrickChange> DrawnLiveSession::take_changes() {
    const Bone& now = stepped_->bone();
    std::vector<BrickChange> changes;
    for (std::size_t number = 0; number < now.stored_bricks(); ++number) {
        const auto slot = static_cast<std::int32_t>(number);
        const BrickFractions after = now.fractions(slot);
        const BrickFractions before = std::as_const(seen_).fractions(slot);
        // Neither bone has a brick of its own there: bones of one case share bricks.
        if (after.data() == before.data()) continue;
        BrickChange change{.brick = now.content().brick_of_slot[number]};
        for (std::size_t voxel = 0; voxel < brick_voxel_count; ++voxel) {
            if (after[voxel] == before[voxel]) continue;
            change.voxels.set(voxel);
            if (after[voxel] > before[voxel]) change.kind = ChangeKind::restored;
        }
        if (change.voxels.none()) continue;
        std::ranges::copy(after, seen_.fractions(slot).begin());
        changes.push_back(change);
    }
    return changes;
}

}  // namespace osteomill::python
