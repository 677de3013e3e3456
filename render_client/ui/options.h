// The command line of render_client.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "common/net/tls_options.h"
#include "render_client/ui/dataset_options.h"
#include "render_client/ui/panels/theme.h"
#include "render_client/ui/view/cut_settings.h"
#include "render_client/ui/view/inset_view.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/shading_settings.h"
#include "render_client/volume/stereo.h"
#include "render_client/volume/textures/texture_plan.h"

namespace osteomill {

struct RenderOptions {
    std::string host = "127.0.0.1";
    std::uint16_t port = 7010;
    bool names_server = false;                    ///< the command line does
    std::optional<TlsFiles> tls;                  ///< absent: in the clear
    std::optional<std::filesystem::path> record;  ///< received frames are written there, too
    std::optional<std::filesystem::path> replay;  ///< a recording in place of a server
    std::optional<DatasetOptions> dataset;        ///< made of the recording
    double speed = 1.0;                           ///< playback's: recorded seconds a second
    double from_s = 0.0;                          ///< where in the recording it begins
    std::optional<std::filesystem::path> film;    ///< made of the recording, offscreen
    std::string camera{};                         ///< for the recording, one of cameras_named; empty: the
                                                  ///< person's view, in a film the trainee's, if recorded
    RendererChoice renderer = RendererChoice::raycast;
    ShadingSettings look;
    std::filesystem::path
        look_file;  ///< its curves are read from there, if it exists, and saved; empty: the case's
    StereoSettings stereo;
    double magnification = 1.0;
    bool ambient_occlusion = true;
    bool thin_bone = true;
    std::optional<bool> smooth_silhouettes{};  ///< absent: in the window and films, not in image sets
    std::optional<double> specular{};  ///< highlights on bone; absent: as usual, none by another's lamps
    bool grain = true;                 ///< of bone
    bool neutral_sawn_faces = true;
    bool light_field = false;
    InsetKind inset = InsetKind::off;
    CutSettings cuts;  ///< the bone's bounds are not known yet
    bool offscreen = false;
    std::optional<int> gpu{};           ///< offscreen: which of the machine's, from 0; absent: the first
    int frames = 300;                   ///< offscreen: ends after so many
    bool until_server_ends = false;     ///< in a window: close it when the session is over
    std::filesystem::path screenshots;  ///< empty writes none
    int screenshot_every = 0;           ///< 0 spreads about 30 over `frames`
    std::optional<glm::ivec2> window_size_px;
    std::optional<ThemeName> theme{};
    std::optional<double> ui_scale;  ///< for panels and letters; absent: the display's, 1 offscreen
    std::string language = "en";     ///< one of translation.h's
    bool panels = true;
    bool sound = false;                         ///< the burr can be heard
    std::optional<std::filesystem::path> home;  ///< cases and reports of sessions started from the window
    std::size_t texture_budget_bytes = default_texture_budget_bytes;  ///< for the bone
    std::filesystem::path json;                                       ///< empty writes none
};

/// The command line requests no run: usage error (2), or help or version (0).
struct NoRun {
    int exit_code = 0;
    std::string message;  ///< for standard output where the code is 0, else one line for standard error
};

/// Either options or the reason for no run.
struct ParsedOptions {
    RenderOptions options;
    std::optional<NoRun> no_run;
};

/// Every how many frames a picture is written.
int screenshot_interval(const RenderOptions& options);

ParsedOptions parse_options(int argument_count, const char* const* arguments, const std::string& version);

/// "1280x800" as a size. Throws std::invalid_argument unless both are whole numbers from 1 to 16384.
glm::ivec2 parse_size(const std::string& text);

}  // namespace osteomill
