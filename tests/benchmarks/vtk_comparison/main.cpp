// vtk_comparison: what one frame of the tooth phantom at 640 x 480 costs us and VTK 9.1, in CPU time of all
// threads, and how near each comes to its own picture with samples a tenth of a voxel apart.
//
// VTK's mappers sample once a voxel and use one lamp at the camera; ours is the product's, with its three
// lights and ambient occlusion. Ours leaves out what holds no bone by itself; VTK is measured with the whole
// grid, as a scan comes, and cropped by hand. Parts take turns, each in a process of its own:
//     build/release/bin/vtk_comparison
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/benchmarks/vtk_comparison/comparison.h"
#include "tests/benchmarks/vtk_comparison/measured_part.h"

int main(int argument_count, char** arguments) {
    CLI::App app("The cost of a frame beside VTK's");
    std::string part;
    int rounds = 2;
    int frames = 3;
    bool reference = false;
    std::filesystem::path task;
    std::optional<int> gpu;
    std::filesystem::path folder = "out/vtk_comparison";
    app.add_option("--part", part,
                   "one part alone: ours, vtk-gpu, vtk-cpu, vtk-gpu-cropped or vtk-cpu-cropped");
    app.add_option("--task", task,
                   "VTK's GPU mapper alone, as this file of osteomill_study render --full-rate says");
    app.add_option("--gpu", gpu, "with --task: on this GPU of several, counted from 0");
    app.add_flag("--reference", reference, "with --part: draw its reference pictures");
    app.add_option("--rounds", rounds, "how often each part has its turn")->check(CLI::PositiveNumber);
    app.add_option("--frames", frames, "of each kind in a turn")->check(CLI::PositiveNumber);
    app.add_option("--out", folder, "where the pictures go");
    try {
        app.parse(argument_count, arguments);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        std::filesystem::create_directories(folder);
        if (!task.empty()) {
            std::ifstream file(task);
            osteomill::draw_task(osteomill::study::task_of(nlohmann::ordered_json::parse(file)), gpu, folder);
        } else if (part.empty())
            osteomill::compare(std::filesystem::read_symlink("/proc/self/exe"), rounds, frames, folder);
        else if (reference)
            osteomill::draw_references(part, folder);
        else
            std::cout << osteomill::measure_part(part, frames, folder).dump() << '\n';
    } catch (const std::exception& error) {
        std::cerr << "vtk_comparison: " << error.what() << '\n';
        return 1;
    }
    return 0;
}
