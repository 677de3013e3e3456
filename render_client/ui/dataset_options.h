// Options of an image set on the command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "render_client/dataset/dataset_contents.h"

namespace osteomill {

class CommandOption;
class CommandOptions;

struct DatasetOptions {
    std::filesystem::path folder;
    std::string cameras{};                 ///< as of cameras_named
    std::optional<double> frames_per_s{};  ///< in recorded time; absent: every recorded state
    DatasetImages images{};
    DatasetPart part{};
    std::optional<std::uint64_t> randomise{};  ///< seed of domain randomisation; absent: as in the window
};

/// --dataset, --cameras, --dataset-fps, --dataset-images, --randomise and --shard, into `dataset`, which
/// outlives the parsing; behind the app's other options. Returns the first, without which the others are
/// refused.
CommandOption add_dataset_options(CommandOptions& app, DatasetOptions& dataset);

}  // namespace osteomill
