#include "studies/render/render_options.h"

#include <cstdlib>

namespace osteomill::study {

CLI::App* add_render(CLI::App& app, RenderStudyOptions& options) {
    options.out = "study/render";
    if (const char* const scans = std::getenv("OSTEOMILL_SCANS")) options.scans = scans;
    CLI::App* render = app.add_subcommand(
        "render", "the pictures: frame time against accuracy, sizes and settings; upload against carve");
    render->add_option("--out", options.out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
    render
        ->add_option_function<int>(
            "--width-px",
            [&options](int width_px) { options.size_px = glm::ivec2(width_px, 3 * width_px / 4); },
            "width of the pictures, 4:3 (640; 240 with --quick)")
        ->check(CLI::Range(64, 4096));
    render->add_flag("--quick", options.quick, "fewer settings, smaller pictures: under a minute");
    render->add_flag("--zooms", options.zooms_only,
                     "only the pictures of every bone at three zooms, into OUT/zooms");
    return render;
}

}  // namespace osteomill::study
