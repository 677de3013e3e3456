// `osteomill_study render` on the command line.
#pragma once

#include <CLI/CLI.hpp>

#include "studies/render/render_study.h"

namespace osteomill::study {

/// The subcommand, which fills in `options`; both outlive parsing.
CLI::App* add_render(CLI::App& app, RenderStudyOptions& options);

}  // namespace osteomill::study
