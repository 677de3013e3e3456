// render_client: shows the bone that haptic_server mills.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

#include "common/log/line_stream.h"
#include "common/program/run_program.h"
#include "common/text/foreign_text.h"
#include "common/words/translation.h"
#include "render_client/link/bone_link.h"
#include "render_client/link/recording_player.h"
#include "render_client/sound/speaker.h"
#include "render_client/ui/dataset_run.h"
#include "render_client/ui/film_run.h"
#include "render_client/ui/offscreen_run.h"
#include "render_client/ui/options.h"
#include "render_client/ui/view/transfer_file.h"
#include "render_client/ui/windowed_run.h"

namespace {

std::unique_ptr<osteomill::SessionSource> make_session(const osteomill::RenderOptions& options) {
    if (options.replay)
        return std::make_unique<osteomill::RecordingPlayer>(*options.replay, options.speed, options.from_s);
    return std::make_unique<osteomill::BoneLink>(options.host, options.port, options.record, options.tls);
}

/// A recording is finished whatever else goes wrong.
void run(osteomill::RenderOptions options) {
    using namespace osteomill;
    std::error_code failed;
    if (!options.look_file.empty() && std::filesystem::exists(options.look_file, failed))
        options.look.transfer = read_transfer(options.look_file);
    speak(options.language);
    const auto stop_requested = [&stop = stop_on_signals()] { return stop.load(); };
    if (options.dataset) {
        const RenderReport report = run_dataset(options, OSTEOMILL_VERSION, stop_requested);
        if (!options.json.empty()) write_report(report, options.json);
        return;
    }
    const auto session = make_session(options);
    std::exception_ptr failure;
    try {
        const RenderReport report = options.film        ? run_film(options, *session, stop_requested)
                                    : options.offscreen ? run_offscreen(options, *session, stop_requested)
                                                        : run_in_window(options, *session, stop_requested);
        if (!options.json.empty()) write_report(report, options.json);
    } catch (const std::exception&) {
        failure = std::current_exception();
    }
    const std::string unfinished = session->finish();
    if (failure) std::rethrow_exception(failure);
    if (!unfinished.empty()) throw std::runtime_error(unfinished);
}

}  // namespace

int render_client_main(int argument_count, char** arguments) {
    using namespace osteomill;
    ignore_signals_of_streams();
    quiet_sound_libraries();
    const ParsedOptions parsed = parse_options(argument_count, arguments, OSTEOMILL_VERSION);
    if (parsed.no_run) {
        if (parsed.no_run->exit_code == 0)
            std::fputs(parsed.no_run->message.c_str(), stdout);
        else
            std::fprintf(stderr, "%s\n", printable(parsed.no_run->message).c_str());
        return parsed.no_run->exit_code;
    }
    const ProgramOutput output;
    log_to(output.err, "render_client");
    int exit_code = 0;
    try {
        run(parsed.options);
    } catch (const std::exception& error) {
        output.err->say(fmt::format("render_client: {}", error.what()));
        exit_code = 1;
    }
    output.finish();
    return exit_code;
}
