// Settings of the view that the user has made; keys, panels and the command line change it.
#pragma once

#include <array>
#include <string>

#include "common/session/session_control.h"
#include "render_client/ui/panels/theme.h"
#include "render_client/ui/panels/transfer_editor.h"
#include "render_client/ui/view/cut_settings.h"
#include "render_client/ui/view/inset_view.h"
#include "render_client/volume/scene_appearance.h"

namespace osteomill {

/// A question to the user in the middle of the picture.
enum class SessionQuestion {
    none,
    mark,     ///< the text of a note
    reset,    ///< undo everything?
    finish,   ///< end the session for everybody?
    surface,  ///< as which kind of file is the bone's surface saved?
    end,      ///< end this program?
};

struct ViewSettings {
    ThemeName theme = ThemeName::dark;
    float scale = 1.0f;  ///< size of panels and letters: 2 on a display twice as dense
    bool panels_shown = true;
    bool playback_shown = true;  ///< the bar of a recording; in a film nobody can press it
    bool help_shown = false;
    bool details_shown = false;  ///< about link, delay, picture and solver
    bool is_fullscreen = false;
    bool cuts_panel_shown = false;
    bool transfer_panel_shown = false;
    CutSettings cuts;
    TransferEditor transfer;
    bool transfer_has_file = false;     ///< the curves of `transfer` can be saved
    bool transfer_save_wanted = false;  ///< and somebody pressed the button
    bool slices_shown = false;
    bool ambient_occlusion = true;
    bool smooth_silhouettes = true;
    bool thin_bone = true;           ///< which shows things behind it
    float specular = usual_wetness;  ///< highlights on bone, see SceneAppearance
    bool grain = true;
    bool neutral_sawn_faces = true;
    bool sound = false;        ///< the burr is to be heard,
    bool warns = true;         ///< and a tone where it is near a protected structure
    bool light_field = false;  ///< a microscope's round field
    InsetKind inset = InsetKind::off;
    SessionQuestion question = SessionQuestion::none;
    std::array<char, SessionControl::longest_text + 1> note{};  ///< a mark's text, while it is written
    bool click_places = false;  ///< the next click on bone says where the tool goes
    bool moves_bone = false;    ///< drags move and turn the bone under the tool, which holds still
    bool drag_tilts = false;    ///< the left button tilts the handpiece instead of moving it
    std::string notice;         ///< one line for a few seconds; empty: none
};

}  // namespace osteomill
