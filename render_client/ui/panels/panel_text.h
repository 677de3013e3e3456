// The text of the panels, in colours: no drawing, no layout.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/bone/bone.h"
#include "render_client/ui/panels/seen_session.h"
#include "render_client/ui/view/view_settings.h"
#include "render_client/volume/picture.h"

namespace osteomill {

struct TextPiece {
    Tone tone = Tone::plain;
    std::string text;
};
using TextLine = std::vector<TextPiece>;
using PanelText = std::vector<TextLine>;

/// The state of the picture under the panels.
struct PictureProgress {
    double frames_per_s = 0.0;
    PictureQuality quality{};
    /// Progress of a new bone or appearance; nothing when all is shown.
    std::optional<int> preparation_percent{};
    /// The reason for a missing bone in the picture, if there is one.
    std::string bone_problem{};
};

/// Scene, connection, rates. `is_page_hidden`: there is a page of cases to go back to.
PanelText session_text(const SeenSession& session, const PictureProgress& picture, const ViewSettings& view,
                       bool is_page_hidden);
/// Burr, spindle, removed volume of a session with a tool. `bone`: null until one has come.
PanelText tool_text(const SeenSession& session, const Bone* bone);
/// Warnings that must not be overlooked, and the notice; empty without any.
PanelText warning_text(const SeenSession& session, const std::string& bone_problem,
                       const std::string& notice);
/// The notice alone: there may be no session.
PanelText notice_text(const std::string& notice);
/// Whether there is a fault, or the burr is near a protected structure: a banner with a frame round the
/// picture says so.
bool is_alarm(const SeenSession& session);
/// Pedal, and the client that has the tool, of a session with an operator_command.
PanelText operator_text(const SeenSession& session);

// Texts about protected structures: the distance of the nearest, and the touched ones.

/// The nearest by name with its distance, and every structure that was touched, for as long as the session
/// lasts; empty if the session protects nothing.
PanelText structure_text(const SeenSession& session);
/// Those that the burr touches or is within the warning distance of; mostly none.
PanelText structure_warnings(const SeenSession& session);

}  // namespace osteomill
