#include "studies/render/full_rate/vtk_frames.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "analysis/output/output_files.h"
#include "common/program/child_program.h"

namespace osteomill::study {

namespace {

constexpr std::chrono::milliseconds between_looks(20);

void run_to_its_end(const std::vector<std::string>& command) {
    ChildProgram program(command);
    while (program.is_running()) {
        std::this_thread::sleep_for(between_looks);
        program.poll();
    }
    if (*program.status() == 0) return;
    const std::string last_line = program.last_line();
    throw std::runtime_error(last_line.empty()
                                 ? fmt::format("{} ended with status {}", command[0], *program.status())
                                 : last_line);
}

}  // namespace

std::optional<std::filesystem::path> vtk_program() {
    const std::filesystem::path program =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "vtk_comparison";
    if (!std::filesystem::exists(program)) return std::nullopt;
    return program;
}

VtkFrames draw_by_vtk(const std::filesystem::path& program, const DrawingTask& task, std::optional<int> gpu,
                      const std::filesystem::path& folder) {
    const std::filesystem::path task_file = folder / ("vtk_" + task.phantom + "_task.json");
    write_json(json_of(task), task_file);
    std::vector<std::string> command{program, "--task", task_file, "--out", folder};
    if (gpu) command.insert(command.end(), {"--gpu", std::to_string(*gpu)});
    run_to_its_end(command);
    std::ifstream file(folder / ("vtk_" + task.phantom + ".json"));
    const auto drawn = nlohmann::ordered_json::parse(file);
    return {.gl_renderer = drawn.at("gl_renderer"),
            .orbit = frames_of(drawn.at("orbit")),
            .carve = frames_of(drawn.at("carve"))};
}

}  // namespace osteomill::study
