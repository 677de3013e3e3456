// The text of the panels, in colours: no drawing, no layout.
#pragma once

#include <string>
#include <vector>

#include "render_client/ui/panels/overlay.h"

namespace osteomill {

struct TextPiece {
    Tone tone = Tone::plain;
    std::string text;
};
using TextLine = std::vector<TextPiece>;
using PanelText = std::vector<TextLine>;

/// Scene, connection, rates.
PanelText session_text(const OverlayContent& content);
/// Burr, spindle, removed volume; needs content.tool.
PanelText tool_text(const OverlayContent& content);
/// Warnings that must not be overlooked, and the notice; empty without any.
PanelText warning_text(const OverlayContent& content);
/// The notice alone: there may be no session.
PanelText notice_text(const OverlayContent& content);
/// Whether there is a fault, or the burr is near a protected structure: a banner with a frame round the
/// picture says so.
bool is_alarm(const OverlayContent& content);
/// Pedal, and the client that has the tool; needs content.operator_command.
PanelText operator_text(const OverlayContent& content);

}  // namespace osteomill
