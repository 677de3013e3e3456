// The picture as the command line asks for it, in a window and without one.
#pragma once

#include "render_client/ui/options.h"
#include "render_client/ui/view/session_picture.h"

namespace osteomill {

inline void take_over(SessionPicture& session, const RenderOptions& options) {
    session.limit_textures({.budget_bytes = options.texture_budget_bytes});
    session.set_first_magnification(options.magnification);
    ViewSettings& view = session.view();
    view.theme = options.theme.value_or(ThemeName::dark);
    view.ambient_occlusion = options.ambient_occlusion;
    view.thin_bone = options.thin_bone;
    view.smooth_silhouettes = options.smooth_silhouettes.value_or(true);
    view.specular = static_cast<float>(options.specular.value_or(usual_wetness));
    view.grain = options.grain;
    view.neutral_sawn_faces = options.neutral_sawn_faces;
    view.light_field = options.light_field;
    view.inset = options.inset;
    view.cuts = options.cuts;
    view.panels_shown = options.panels;
}

}  // namespace osteomill
