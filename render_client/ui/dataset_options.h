// What an image set is to hold, and its options on the command line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace osteomill {

/// Which of a frame's images are written.
struct DatasetImages {
    bool colour = true;
    bool depth = true;
    bool labels = true;
    bool normals = true;
    bool ray_depth = false;
};

/// Part `number` of `of`, 1 to `of`, for one process among several: every of-th frame.
struct DatasetPart {
    std::size_t number = 1;
    std::size_t of = 1;

    bool has(std::size_t frame) const { return frame % of == number - 1; }
};

struct DatasetOptions {
    std::filesystem::path folder;
    std::filesystem::path cameras;         ///< camera_file.h; empty: one, at the first view of a session
    std::optional<double> frames_per_s{};  ///< of recorded time; absent: every recorded state
    DatasetImages images{};
    DatasetPart part{};
    std::optional<std::uint64_t> randomise{};  ///< seed of domain randomisation; absent: as in the window
};

/// --dataset, --cameras, --dataset-fps, --dataset-images, --randomise and --shard, into `dataset`, which
/// outlives the parsing; behind the app's other options. Returns the first, without which the others are
/// refused.
CLI::Option* add_dataset_options(CLI::App& app, DatasetOptions& dataset);

}  // namespace osteomill
