#include "tests/benchmarks/vtk_comparison/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "render_client/volume/png_file.h"
#include "tests/benchmarks/vtk_comparison/measured_part.h"
#include "tests/support/child_process.h"

namespace osteomill {

namespace {

constexpr std::chrono::seconds longest_part(1800);

std::string run_part(const std::vector<std::string>& command) {
    const testing::Finished finished = testing::run_program(command, longest_part);
    if (finished.status != 0)
        throw std::runtime_error(fmt::format("{} failed: {}", command[2], finished.err));
    return finished.out;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// 10 log10(255^2 / mean square error) over all three channels, dB.
double psnr_db(const Picture& picture, const Picture& reference) {
    double squares = 0.0;
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
        const double difference = static_cast<double>(picture.rgb[i]) - reference.rgb[i];
        squares += difference * difference;
    }
    return 10.0 * std::log10(255.0 * 255.0 * static_cast<double>(picture.rgb.size()) / squares);
}

/// All values of one kind, over the rounds of a part.
std::vector<double> gathered(const std::vector<nlohmann::json>& rounds, const std::string& view,
                             const std::string& frame, const std::string& unit) {
    std::vector<double> values;
    for (const nlohmann::json& round : rounds)
        for (const double value : round.at(view).at(frame).at(unit)) values.push_back(value);
    return values;
}

}  // namespace

void compare(const std::string& program, int rounds, int frames, const std::filesystem::path& folder) {
    std::vector<std::vector<nlohmann::json>> measured(part_names.size());
    for (int round = 0; round < rounds; ++round)
        for (std::size_t part = 0; part < part_names.size(); ++part)
            measured[part].push_back(nlohmann::json::parse(run_part(
                {program, "--part", part_names[part], "--frames", std::to_string(frames), "--out", folder})));
    for (const char* part : part_names) run_part({program, "--part", part, "--reference", "--out", folder});

    fmt::print("{:<10}{:<14}{:<17}{:>10}{:>10}{:>14}{:>10}\n", "view", "frame", "part", "CPU ms", "wall ms",
               "times our CPU", "PSNR dB");
    for (const std::string view : view_names)
        for (const std::string frame : {"full", "after_change"})
            for (std::size_t part = 0; part < part_names.size(); ++part) {
                const double ours_ms = median(gathered(measured[0], view, frame, "cpu_ms"));
                const double cpu_ms = median(gathered(measured[part], view, frame, "cpu_ms"));
                const std::string file = fmt::format("{}-{}", part_names[part], view);
                const double db =
                    psnr_db(read_png(folder / (file + ".png")), read_png(folder / (file + "-reference.png")));
                fmt::print("{:<10}{:<14}{:<17}{:>10.1f}{:>10.1f}{:>14.1f}{:>10}\n", view, frame,
                           part_names[part], cpu_ms, median(gathered(measured[part], view, frame, "wall_ms")),
                           cpu_ms / ours_ms, frame == "full" ? fmt::format("{:.1f}", db) : "");
            }
}

}  // namespace osteomill
