#include "studies/render/render_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <memory>

#include "render_client/ui/options.h"
#include "studies/render/render_study.h"

namespace osteomill::study {

StudyCommand add_render(CLI::App& app) {
    const auto shared = std::make_shared<RenderStudyOptions>();
    RenderStudyOptions& options = *shared;
    options.out = "study/render";
    if (const char* const scans = std::getenv("OSTEOMILL_SCANS")) options.scans = scans;
    CLI::App* render =
        app.add_subcommand("render", "the pictures: frame time against accuracy, how smooth a cut looks");
    add_out(*render, options.out);
    render
        ->add_option_function<int>(
            "--width-px",
            [&options](int width_px) { options.size_px = glm::ivec2(width_px, 3 * width_px / 4); },
            "width of the pictures, 4:3 (640; 240 with --quick)")
        ->check(CLI::Range(64, 4096));
    auto* const full_rate = render->add_flag(
        "--full-rate", options.full_rate_only,
        "only what a graphics card draws in a second at 2560 x 1440, orbiting and carving, "
        "with uploads and texture memory; smaller and shorter where a software rasteriser draws");
    render
        ->add_option_function<std::string>(
            "--size-px",
            [&options](const std::string& text) {
                options.size_px = parse_size(text);
                if (!options.size_px)
                    throw CLI::ValidationError(
                        "--size-px", "is '" + text + "', not WIDTHxHEIGHT in pixels, each 1 to 16384");
            },
            "size of these pictures (2560x1440; 640x360 by a software rasteriser)")
        ->needs(full_rate)
        ->excludes("--width-px")
        ->type_name("WxH");
    render->add_option("--frames", options.frames, "of each of their rows (600; 8 by a software rasteriser)")
        ->needs(full_rate)
        ->check(CLI::Range(1, 1'000'000));
    render
        ->add_option(
            "--gpu", options.gpu,
            "draw on this GPU of several, counted from 0 (the first; where there is none, Mesa's software "
            "rasteriser)")
        ->check(CLI::Range(0, 63));
    render->add_flag("--quick", options.quick, "fewer settings, smaller pictures: under a minute");
    return {
        .subcommand = render,
        .run = [shared](const StudySurroundings& surroundings) { run_render_study(*shared, surroundings); },
        .runs_one_by_one = true};
}

}  // namespace osteomill::study
