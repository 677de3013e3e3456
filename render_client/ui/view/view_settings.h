// Settings of the view that the user has made; keys, panels and the command line change it.
#pragma once

#include <string>

#include "render_client/ui/panels/theme.h"
#include "render_client/ui/panels/transfer_editor.h"
#include "render_client/ui/view/cut_settings.h"

namespace osteomill {

struct ViewSettings {
    ThemeName theme = ThemeName::dark;
    float scale = 1.0f;  ///< of panels and letters: 2 on a display twice as dense
    bool panels_shown = true;
    bool help_shown = false;
    bool cuts_panel_shown = false;
    bool transfer_panel_shown = false;
    CutSettings cuts;
    TransferEditor transfer;
    std::string notice;  ///< one line for a few seconds; empty: none
};

}  // namespace osteomill
