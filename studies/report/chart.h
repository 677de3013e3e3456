// Charts by gnuplot: a script beside the study's sources, a folder of tables in, an SVG out.
#pragma once

#include <filesystem>
#include <string>

namespace osteomill::study {

/// Runs `NAME.gp` of the folder `scripts` with the variable `folder` set to where the tables are; it writes
/// NAME.svg there. Throws std::runtime_error in one line where gnuplot is not installed, the script is not
/// there, or gnuplot fails (with the last line of what it said).
void draw_chart(const std::filesystem::path& scripts, const std::string& name,
                const std::filesystem::path& folder);

/// Where the study's scripts are: beside its sources, or where an installed program finds them
/// (PROGRAM/../share/osteomill/charts). Throws std::runtime_error where they are in neither place.
std::filesystem::path chart_scripts();

}  // namespace osteomill::study
