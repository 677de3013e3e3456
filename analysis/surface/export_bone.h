// bone_export without its main: a bone file in, its surface or the removed bone out.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/program/progress.h"
#include "common/program/run_program.h"

namespace osteomill {

struct ExportOptions {
    std::filesystem::path bone;
    std::filesystem::path output;
    std::optional<double> threshold_hu{};
    std::optional<double> cell_mm{};  ///< the surface's cell: the bone's own spacing, or about so long
    std::optional<std::filesystem::path> original{};  ///< write the bone that is gone from this one, and no
                                                      ///< surface
};

/// Throws std::invalid_argument with one line for wrong usage.
ParseResult<ExportOptions> parse_export_command_line(int argc, const char* const* argv,
                                                     const std::string& version);

/// Writes the file and gives a line about its contents to `say`. `progress` is called before each part of the
/// work; if it throws, the work ends and nothing is written. Throws std::exception with one line for a file
/// that holds no bone, bones of two grids, a bone that was not carved from the original, an output that
/// cannot be written.
void export_bone(const ExportOptions& options, const std::function<void(const std::string&)>& say,
                 const ReportProgress& progress);

}  // namespace osteomill
