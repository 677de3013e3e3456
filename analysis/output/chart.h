// Charts by gnuplot: a script beside the study's sources, a folder of tables in, an SVG out.
#pragma once

#include <filesystem>
#include <string>

namespace osteomill::study {

/// Runs `NAME.gp` of the folder `scripts` with the variable `folder` set to where the tables are; it writes
/// NAME.svg there. Throws std::runtime_error in one line where gnuplot is not installed, the script is not
/// there, or gnuplot fails (with the last line of what it said) or cannot write all of the chart.
void draw_chart(const std::filesystem::path& scripts, const std::string& name,
                const std::filesystem::path& folder);

/// Where the study's scripts are: where an installed program finds them (PROGRAM/../share/osteomill/charts),
/// or beside its sources. Throws std::runtime_error where they are in neither place.
std::filesystem::path chart_scripts();

/// The first of the folders that holds scripts. Throws std::runtime_error that names both where neither does.
std::filesystem::path folder_with_scripts(const std::filesystem::path& installed,
                                          const std::filesystem::path& beside_sources);

/// To be called before hours of work rather than after them: throws std::runtime_error in one line where no
/// chart could be drawn, for want of the scripts or of gnuplot.
void require_charts();

}  // namespace osteomill::study
