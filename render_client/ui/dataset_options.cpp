#include "render_client/ui/dataset_options.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/program/command_options.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

/// "2/8". Throws std::invalid_argument.
DatasetPart part_named(const std::string& text) {
    const std::string_view all = text;
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto number = parse_number<std::size_t>(all.substr(0, slash));
    const auto of = parse_number<std::size_t>(all.substr(std::min(slash + 1, text.size())));
    if (!number || !of || *number < 1 || *number > *of)
        throw std::invalid_argument("'" + text + "' is no part I/N with 1 <= I <= N, such as 2/8");
    return {*number, *of};
}

}  // namespace

CommandOption add_dataset_options(CommandOptions& app, DatasetOptions& dataset) {
    const CommandOption folder =
        app.add_option("--dataset", dataset.folder,
                       "Write an image set of the recording: pictures, depth, labels, normals and poses "
                       "(docs/datasets.md)")
            .type_name("DIR");
    app.add_option(
           "--cameras", dataset.cameras,
           "Cameras of the image set: a TOML file, or trainee: from where the one looked who moved the "
           "tool (one, at the first view)")
        .type_name("FILE|trainee")
        .needs(folder);
    app.add_option("--dataset-fps", dataset.frames_per_s,
                   "Frames a recorded second of the image set (every recorded state)")
        .check(within(0.001, 1000.0))
        .needs(folder);
    app.add_read(
           "--dataset-images",
           [&](const std::string& text) { dataset.images = images_named(cells_of(text)); },
           "The images to write, of colour, depth, ray-depth, labels, normals (all but ray-depth)")
        .type_name("KIND,...")
        .needs(folder);
    app.add_option(
           "--randomise", dataset.randomise,
           "Pictures of the image set under lamps, in colours, of wetness and by cameras that are drawn "
           "by lot, frame by frame, from this seed")
        .type_name("SEED")
        .needs(folder);
    app.add_read(
           "--shard", [&](const std::string& text) { dataset.part = part_named(text); },
           "Only part I of N of the image set's frames, for one process among several")
        .type_name("I/N")
        .needs(folder);
    // An image set shows things as they are, alike in picture and numbers.
    for (const char* other :
         {"--renderer", "--shading", "--transfer", "--look", "--cut", "--stereo", "--magnification",
          "--light-field", "--inset", "--screenshots", "--offscreen", "--sound", "--speed", "--window-size"})
        folder.excludes(other);
    return folder;
}

}  // namespace osteomill
