#include "render_client/ui/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/files/distinct_files.h"
#include "common/net/listen_address.h"
#include "common/net/tls_options.h"
#include "common/program/command_options.h"
#include "common/text/words.h"
#include "common/words/translation.h"
#include "render_client/link/recording_player.h"
#include "render_client/volume/camera.h"

namespace osteomill {

namespace {

constexpr int largest_window_px = 16384;
constexpr int wanted_screenshots = 30;

std::optional<int> whole_number(std::string_view text, int low, int high) {
    const auto value = parse_number<int>(text);
    return value && *value >= low && *value <= high ? value : std::nullopt;
}

/// A side of the patient that a cut can take away.
struct CutSide {
    const char* name;
    std::size_t axis;
    double sign;  // along the axis, patient LPS
};
constexpr std::array cut_sides{CutSide{"left", 0, 1.0},  CutSide{"right", 0, -1.0},
                               CutSide{"back", 1, 1.0},  CutSide{"front", 1, -1.0},
                               CutSide{"above", 2, 1.0}, CutSide{"below", 2, -1.0}};

/// Adds the cut that "SIDE" or "SIDE:MM" means. Returns the error, or nothing.
std::string take_cut(const std::string& text, CutSettings& cuts) {
    const std::size_t colon = text.find(':');
    const auto side =
        std::find_if(cut_sides.begin(), cut_sides.end(),
                     [name = text.substr(0, colon)](const CutSide& known) { return name == known.name; });
    const std::optional<double> position_mm =
        colon == std::string::npos ? 0.0 : finite_number(std::string_view(text).substr(colon + 1));
    if (side == cut_sides.end() || !position_mm)
        return fmt::format(
            "is '{}', not left, right, front, back, above or below, or one of these with how many mm off the "
            "bone's middle, such as left:2.5",
            text);
    if (cuts[side->axis].is_on) return fmt::format("'{}': there is a cut along that axis already", text);
    glm::dvec3 normal(0.0);
    normal[static_cast<int>(side->axis)] = side->sign;
    cuts.set(side->axis, normal, *position_mm);
    return {};
}

NoRun wrong_usage(const std::string& what) {
    return {2, "render_client: " + what};
}

/// An option with a few named values; any other text is refused with a list of the names.
template <typename Value>
CommandOption add_choice(CommandOptions& app, const std::string& option,
                         const std::vector<std::string>& names, const std::vector<Value>& values,
                         Value& chosen, const std::string& help) {
    return app
        .add_read(
            option,
            [=, &chosen](const std::string& text) {
                const auto name = std::find(names.begin(), names.end(), text);
                if (name == names.end())
                    throw std::invalid_argument(
                        fmt::format("is '{}', not one of {}", text, fmt::join(names, ", ")));
                chosen = values[static_cast<std::size_t>(name - names.begin())];
            },
            help)
        .type_name(fmt::format("{}", fmt::join(names, "|")));
}

void add_look(CommandOptions& app, RenderOptions& options) {
    add_choice(app, "--renderer", {"raycast", "slices"},
               std::vector{RendererChoice::raycast, RendererChoice::slices}, options.renderer,
               "raycast (default) skips what is empty; slices cut the 3D texture, as published");
    add_choice(
        app, "--shading", {"gradient", "surface-voxels"},
        std::vector{Shading::gradient, Shading::surface_voxels}, options.look.shading,
        "Light by the gradient in every pixel (default), or once for each surface voxel, as published");
    std::vector<std::string> names;
    std::vector<std::optional<TransferFunction>> presets;
    for (const TransferFunction& preset : transfer_presets()) {
        names.push_back(preset.name);
        presets.emplace_back(preset);
    }
    add_choice(app, "--transfer", names, presets, options.look.transfer,
               "Colour and opacity by stiffness; unless given, tissues in their own colours");
    app.add_option("--look", options.look_file,
                   "The same as edited before (F5): read from this file, if it is there, and saved to it")
        .type_name("FILE")
        .excludes("--transfer");
    app.add_flag("!--no-ambient-occlusion", options.ambient_occlusion,
                 "No soft shadow of the bone on itself, a little faster; never with surface-voxels");
    app.add_flag(
        "!--no-thin-bone", options.thin_bone,
        "Thin bone hides what is behind it; unless given, it takes on the colour of a sinus or a nerve");
    app.add_switch(
        "--smooth-silhouettes,!--no-smooth-silhouettes",
        [&](bool is_smooth) { options.smooth_silhouettes = is_smooth; },
        "Antialiased outlines of the bone, or none; unless given, the window and films have them, at 4 to 9 "
        "% "
        "of a frame's time, and image sets do not; never of slices");
    app.add_flag("!--no-grain", options.grain,
                 "No fine grain of bone, which stays with it; never with surface-voxels");
    app.add_flag(
        "!--no-neutral-sawn-faces", options.neutral_sawn_faces,
        "Tissue colours also where the piece is sawn off; unless given, its sawn faces are grey-beige");
    app.add_option(
           "--specular", options.specular,
           "Highlights on the bone, as where it is wet, 0 to 1 (0.25; 0: matt); not with surface-voxels")
        .check(within(0.0, 1.0));
    app.add_read_list(
           "--cut",
           [&](const std::vector<std::string>& texts) {
               for (const std::string& text : texts)
                   if (const std::string wrong = take_cut(text, options.cuts); !wrong.empty())
                       throw std::invalid_argument(wrong);
           },
           "Open the bone: its left, right, front, back, above or below is gone, from so many mm beyond its "
           "middle on (0); "
           "up to three")
        .type_name("SIDE[:MM]");
}

void add_stereo(CommandOptions& app, StereoSettings& stereo) {
    add_choice(app, "--stereo", {"off", "side-by-side", "top-bottom", "rows", "quad-buffer"},
               std::vector{StereoLayout::off, StereoLayout::side_by_side, StereoLayout::top_bottom,
                           StereoLayout::rows, StereoLayout::quad_buffer},
               stereo.layout, "Draw for two eyes, as a 3D display takes it (off)");
    app.add_option("--interpupillary", stereo.interpupillary_mm,
                   "mm between the two eyes, 0 to 200 (0.08 of the convergence, as in a microscope)")
        .check(within(0.0, 200.0))
        .type_name("MM");
    app.add_option("--convergence", stereo.convergence_mm,
                   "mm from the eyes to what is seen at the display's depth, 1 to 10000 (what the view turns "
                   "about)")
        .check(within(1.0, 10000.0))
        .type_name("MM");
}

void add_microscope(CommandOptions& app, RenderOptions& options) {
    std::vector<std::string> steps;
    for (const double step : magnification_steps) steps.push_back(fmt::format("{}", step));
    add_choice(app, "--magnification", steps,
               std::vector<double>(magnification_steps.begin(), magnification_steps.end()),
               options.magnification, "Magnification of the first view, in the steps of a microscope (1)");
    app.add_flag("--light-field", options.light_field, "Show only a microscope's round field");
    add_choice(app, "--inset", {"off", "endoscope", "axial"},
               std::vector{InsetKind::off, InsetKind::endoscope, InsetKind::axial}, options.inset,
               "A second, small view: along the handpiece, or an axial section through the burr (off)");
}

/// A message on options that contradict one another; empty if they agree.
std::string contradiction(const RenderOptions& options) {
    if (options.dataset && !options.replay) return "--dataset needs --replay FILE";
    if (options.film && !options.replay) return "--film needs --replay FILE";
    if (!options.camera.empty() && !options.replay) return "--camera needs --replay FILE";
    if (!options.camera.empty() && options.dataset)
        return "--camera: the cameras of a --dataset are --cameras";
    if (options.film && (options.offscreen || !options.screenshots.empty() || options.dataset))
        return "--film goes without --offscreen, --screenshots and --dataset: it has its own pictures";
    if (options.gpu && !options.offscreen && !options.film && !options.dataset)
        return "--gpu needs --offscreen; a window is drawn where its display is";
    if (options.offscreen && options.until_server_ends)
        return "--until-server-ends is for a window; an offscreen run always ends with its session";
    if (options.offscreen && options.stereo.layout == StereoLayout::quad_buffer)
        return "--stereo quad-buffer is for a window; offscreen, use side-by-side, top-bottom or rows";
    if (options.stereo.layout == StereoLayout::off &&
        (options.stereo.interpupillary_mm || options.stereo.convergence_mm))
        return "--interpupillary and --convergence need --stereo";
    if (options.screenshot_every > 0 && options.screenshots.empty())
        return "--screenshot-every needs --screenshots DIR";
    return {};
}

/// Names of the files of --screenshots and of --dataset, a folder for each camera in it.
constexpr std::array screenshot_names{"frame_*.png", "final.png"};
constexpr std::array dataset_names{"dataset*.json", "*/[0-9]*_*.png", "*/[0-9]*_*.npy"};

/// Says which two are one; empty if none are.
std::string same_files(const RenderOptions& options, const TlsOptions& tls) {
    std::vector<NamedFile> files = tls.files_read();
    if (options.replay) files.push_back({"--replay", *options.replay, false});
    if (options.record) files.push_back({"--record", *options.record});
    if (options.film) files.push_back({"--film", *options.film});
    if (!options.look_file.empty()) files.push_back({"--look", options.look_file});
    if (!options.json.empty()) files.push_back({"--json", options.json});
    const auto add_folder = [&files](const char* option, const std::filesystem::path& folder,
                                     std::span<const char* const> names) {
        const std::vector<NamedFile> written = files_written_in(option, folder, names);
        files.insert(files.end(), written.begin(), written.end());
    };
    if (!options.screenshots.empty()) add_folder("--screenshots", options.screenshots, screenshot_names);
    // A camera's name may be "trainee", which is no file.
    if (!options.camera.empty()) files.push_back({"--camera", options.camera, false});
    if (options.dataset) {
        add_folder("--dataset", options.dataset->folder, dataset_names);
        if (!options.dataset->cameras.empty())
            files.push_back({"--cameras", options.dataset->cameras, false});
    }
    try {
        require_distinct(files);
    } catch (const std::invalid_argument& same) {
        return same.what();
    }
    return {};
}

}  // namespace

glm::ivec2 parse_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto width = whole_number(std::string_view(text).substr(0, cross), 1, largest_window_px);
    if (cross != std::string::npos && width)
        if (const auto height = whole_number(std::string_view(text).substr(cross + 1), 1, largest_window_px))
            return {*width, *height};
    throw std::invalid_argument("is '" + text + "', not WIDTHxHEIGHT in pixels, each 1 to 16384");
}

int screenshot_interval(const RenderOptions& options) {
    if (options.screenshot_every > 0) return options.screenshot_every;
    return std::max(1, (options.frames + wanted_screenshots - 1) / wanted_screenshots);
}

ParsedOptions parse_options(int argument_count, const char* const* arguments, const std::string& version) {
    ParsedOptions parsed;
    RenderOptions& options = parsed.options;
    CommandOptions app("Shows what is left of the bone that haptic_server mills, or milled.", "render_client",
                       "render_client " + version);

    const CommandOption connect = app.add_read(
                                         "--connect",
                                         [&](const std::string& text) {
                                             const ServerAddress server = parse_server_address(text);
                                             options.host = server.host;
                                             options.port = server.port;
                                             options.names_server = true;
                                         },
                                         "The server's HOST:PORT (127.0.0.1:7010)")
                                      .type_name("HOST:PORT");
    const TlsOptions tls(app);
    const CommandOption record =
        app.add_option("--record", options.record,
                       "Write what the server sends, for --replay and packet_replay; a pcap file")
            .type_name("FILE");
    app.add_option("--replay", options.replay, "Show a recording instead")
        .type_name("FILE")
        .excludes(connect)
        .excludes(record);
    const CommandOption speed =
        app.add_option("--speed", options.speed, "Recorded seconds a second, with --replay (1)")
            .check(within(RecordingPlayer::slowest, RecordingPlayer::fastest));
    const CommandOption from = app.add_option("--from-s", options.from_s,
                                              "With --replay: begin so long after the recording's beginning")
                                   .check(not_below_zero())
                                   .type_name("S");
    app.add_option("--film", options.film,
                   "With --replay: make a film of it, 30 pictures a second, and end; the program ffmpeg "
                   "does it, by the ending of the name (.mp4)")
        .type_name("FILE");
    app.add_option(
           "--camera", options.camera,
           "With --replay: seen by this camera, while the recording goes on: a TOML file as for --cameras, "
           "or trainee: from where the one looked who moved the tool (in a film that, where it is recorded)")
        .type_name("FILE|trainee");
    app.add_read(
           "--window-size", [&](const std::string& text) { options.window_size_px = parse_size(text); },
           "Size of the picture (1280x800; 960x600 offscreen)")
        .type_name("WxH");
    add_look(app, options);
    add_stereo(app, options.stereo);
    add_microscope(app, options);
    add_choice(app, "--theme", {"dark", "light"},
               std::vector<std::optional<ThemeName>>{ThemeName::dark, ThemeName::light}, options.theme,
               "Colours: dark or light (dark)")
        .type_name("NAME");
    options.language = language_of_environment();
    app.add_option("--language", options.language,
                   "Language of the window; by default that of LANG, if there is a translation")
        .check(one_of(languages()))
        .type_name("NAME");
    app.add_option(
           "--ui-scale", options.ui_scale,
           "Size of panels and letters (the display's; 1 offscreen), 0.5 to 4; above 1 less where the window "
           "has no room for it")
        .check(within(0.5, 4.0));
    app.add_flag("!--no-panels", options.panels, "Only the picture: no panels over it");
    app.add_flag("--sound", options.sound, "The burr can be heard: its edges in bone, by tissue and load");
    app.add_read(
           "--home", [&](const std::string& folder) { options.home = folder; },
           "Where cases and reports are of sessions that are started from the window ($HOME/osteomill)")
        .type_name("DIR");
    app.add_flag("--offscreen", options.offscreen, "Draw without a display; write pictures instead");
    app.add_option(
           "--gpu", options.gpu,
           "Offscreen: draw on this GPU of several, counted from 0 (the first; where there is none, Mesa's "
           "software rasteriser)")
        .check(whole_within(0, 63));
    const CommandOption frames =
        app.add_option("--frames", options.frames,
                       "Offscreen: end after so many frames (300), or sooner with the session")
            .check(whole_within(1, 1'000'000));
    app.add_flag("--until-server-ends", options.until_server_ends,
                 "Close the window when the session is over");
    app.add_option("--screenshots", options.screenshots,
                   "Folder for pictures of the run: frame_0001.png ... and final.png")
        .type_name("DIR");
    app.add_option("--screenshot-every", options.screenshot_every,
                   "Write a picture every so many frames (spreads about 30 over --frames)")
        .check(whole_within(1, 1'000'000));
    int texture_budget_mib = 0;
    const CommandOption texture_budget =
        app.add_option(
               "--texture-budget-mib", texture_budget_mib,
               "Graphics memory for the bone (1024); a larger bone is drawn from an atlas of its bricks, or "
               "coarser")
            .check(whole_within(1, 1 << 20))
            .type_name("MIB");
    DatasetOptions dataset;
    const CommandOption wants_dataset = add_dataset_options(app, dataset);
    app.add_option("--json", options.json, "Write what was measured to this file").type_name("FILE");

    try {
        if (const auto text = app.parse_or_text(argument_count, arguments)) {
            parsed.no_run = NoRun{0, *text};
            return parsed;
        }
    } catch (const std::invalid_argument& wrong) {
        parsed.no_run = wrong_usage(wrong.what());
        return parsed;
    }
    if (texture_budget.count() > 0)
        options.texture_budget_bytes = static_cast<std::size_t>(texture_budget_mib) << 20U;
    if (wants_dataset.count() > 0) options.dataset = dataset;
    std::string wrong = contradiction(options);
    if (wrong.empty() && frames.count() > 0 && !options.offscreen) wrong = "--frames needs --offscreen";
    try {
        options.tls = tls.files();
    } catch (const std::invalid_argument& error) {
        wrong = error.what();
    }
    if (wrong.empty() && options.tls && options.replay) wrong = "--tls-cert: a --replay needs no TLS";
    if (wrong.empty()) wrong = same_files(options, tls);
    if (wrong.empty() && speed.count() > 0 && !options.replay) wrong = "--speed needs --replay FILE";
    if (wrong.empty() && from.count() > 0 && !options.replay) wrong = "--from-s needs --replay FILE";
    if (!wrong.empty()) parsed.no_run = wrong_usage(wrong);
    return parsed;
}

}  // namespace osteomill
