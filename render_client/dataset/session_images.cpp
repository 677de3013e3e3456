#include "render_client/dataset/session_images.h"

#include <cmath>
#include <numbers>

#include "render_client/dataset/first_view.h"
#include "render_client/volume/structures/structure_surface.h"

namespace osteomill {

namespace {

std::vector<TissueColour> solid_colours(std::span<const Tissue> tissues) {
    std::vector<TissueColour> colours = tissue_colours(tissues);
    for (TissueColour& colour : colours) colour.opacity = colour.opacity > 0.0 ? 1.0 : 0.0;
    return colours;
}

}  // namespace

DrawnTool tool_as_thing(const ToolState& state, const SessionInfo& session, const KnownShanks& shanks) {
    DrawnTool tool{.state = state, .is_only_a_thing = true};
    const Burr* burr = session.burr_of(state.burr);
    if (burr == nullptr) return tool;
    const bool clockwise = burr->sense == SpindleSense::clockwise;
    tool.burr = {burr->diameter_mm, burr->head, burr->edges, clockwise, shanks.of(state.burr)};
    if (!state.spindle_on) return tool;
    const double turns = spindle_rpm(state, *burr) / 60.0 * state.time_s;
    // Clockwise seen from the shank is negative about the axis from tip to shank.
    tool.spin_rad = (clockwise ? -2.0 : 2.0) * std::numbers::pi * (turns - std::floor(turns));
    return tool;
}

SessionImages::SessionImages(ImagedSession& session, std::span<const DatasetCamera> cameras,
                             const SceneAppearance& look, const TextureLimits& limits)
    : session_(session),
      tissues_(session.session().tissues),
      textures_(session.bone(), solid_colours(tissues_), {}, limits) {
    renderer_.set_appearance(look);
    for (const DatasetCamera& camera : cameras) views_.push_back(std::make_unique<View>(camera, renderer_));
    follow();
}

void SessionImages::follow() {
    shanks_.take_in(&session_.session());
    const std::vector<BrickChange> changes = session_.take_changes();
    const std::span<const VoxelBox> changed = textures_.update(session_.bone(), changes);
    for (const auto& view : views_) {
        view->picture.mark_dirty(textures_, changed);
        view->surface.mark_dirty(changed);
    }
    take_structures();
    if (session_.tool() == nullptr || std::exchange(has_first_view_, true)) return;
    first_view_ = pose_of(first_view(session_.bone(), textures_, &session_.session(), session_.tool()));
}

void SessionImages::take_structures() {
    for (; structures_ < session_.structures().size(); ++structures_) {
        const Structure& structure = session_.structures()[structures_];
        if (structure.tissue >= tissues_.size() || tissues_[structure.tissue].opacity <= 0.0) continue;
        const Tissue& tissue = tissues_[structure.tissue];
        const StructureMask soft = soft_part(structure.mask, session_.bone());
        const StructureSurface surface = surface_of(soft, linear_from_srgb(tissue.colour_rgb));
        textures_.add_structure(tissue.label, soft);
        for (const auto& view : views_) {
            view->picture.add_structure(surface, 1.0);
            view->surface.add_structure(surface, label_of_tissue(structure.tissue));
        }
    }
    for (auto changed = textures_.work(session_.bone()); !changed.empty();
         changed = textures_.work(session_.bone()))
        for (const auto& view : views_) view->picture.mark_dirty(textures_, changed);
}

CameraImages SessionImages::draw(std::size_t camera, bool wants_colour, bool wants_surface) {
    View& view = *views_.at(camera);
    const BallInView ball = ball_round(textures_);
    const std::optional<Viewpoint>& trainee = session_.view();
    CameraImages images{.camera = view.camera.pose_at(session_.time_s(), first_view_, trainee),
                        .pinhole = view.camera.pinhole_at(trainee),
                        .colour = Picture(glm::ivec2(0))};
    const Camera drawn = camera_of(images.pinhole, images.camera, ball.centre_mm, ball.radius_mm);
    std::optional<DrawnTool> tool;
    if (session_.tool()) tool = tool_as_thing(*session_.tool(), session_.session(), shanks_);
    const DrawnTool* shown = tool ? &*tool : nullptr;
    if (wants_colour) images.colour = view.picture.draw(&textures_, shown, drawn).read_back();
    if (!wants_surface) return images;
    images.surface = view.surface.draw(textures_, shown, drawn);
    images.labels = surface_labels(images.surface, drawn, session_.bone(), tissues_);
    return images;
}

}  // namespace osteomill
