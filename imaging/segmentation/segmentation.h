// A segmentation: which voxels of a scan belong to which structures, as 3D Slicer writes it (.seg.nrrd or
// DICOM SEG, with names and overlapping layers) or as a plain label map of any format, whose segments bear
// their number as name; if there is only one, the file's name. In coloured pictures every colour but black is
// a segment, named by its colour ("#ff0000").
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "imaging/formats/source_image.h"
#include "imaging/segmentation/colour_table.h"

namespace osteomill {

/// Labels of an image's voxels, kept as runs of equal labels along its rows: a label map is mostly such, and
/// a structure is found in it without looking at every voxel.
class LabelRows {
  public:
    /// From where the run before it in its row ends (the first: 0) up to `end`, which is not of it.
    struct Run {
        std::int32_t end = 0;
        std::uint16_t label = 0;
    };

    LabelRows() = default;
    LabelRows(const glm::ivec3& size_voxels, int layers);

    /// The next row of all layers, j before k: `labels` has those of a voxel side by side.
    void add_row(std::span<const std::uint16_t> labels);

    int layers() const { return static_cast<int>(by_layer_.size()); }
    std::span<const Run> row(int layer, int j, int k) const;
    std::uint16_t at(int layer, const glm::ivec3& voxel) const;
    /// Ascending, without 0.
    std::vector<std::uint16_t> labels_in(int layer) const;
    /// How many runs there are of all layers.
    std::size_t runs() const;

    /// Calls visit(first, end, j, k) for every run of the label in a layer, `end` being past it.
    template <typename Visit>
    void for_each_run(int layer, std::uint16_t label, const Visit& visit) const {
        for (int k = 0; k < size_.z; ++k)
            for (int j = 0; j < size_.y; ++j) {
                std::int32_t first = 0;
                for (const Run& run : row(layer, j, k)) {
                    if (run.label == label) visit(first, run.end, j, k);
                    first = run.end;
                }
            }
    }

  private:
    struct Layer {
        std::vector<Run> runs{};
        std::vector<std::size_t> end_of_row{};
    };
    glm::ivec3 size_{0};
    std::vector<Layer> by_layer_;
};

struct Segment {
    std::string name;
    int layer = 0;
    std::uint16_t label = 0;  ///< within its layer
    std::optional<std::array<std::uint8_t, 3>> colour_rgb{};

    bool operator==(const Segment&) const = default;
};

struct Segmentation {
    std::filesystem::path path;
    SourceImage image;
    std::vector<Segment> segments;
    bool is_plain_map = false;  ///< its segments have no names of their own
    bool is_by_colour = false;  ///< a plain map of coloured pictures
    LabelRows labels;
};

/// Throws ImagingError, in one line, for anything that open_labels refuses, names that do not fit their
/// labels, labels that are no whole numbers from 0 to 65535 (within 0.01), more than 4096 different ones, and
/// more than the allowed memory.
Segmentation read_segmentation(const std::filesystem::path& path,
                               const std::optional<glm::dvec3>& stack_spacing_mm = std::nullopt);

/// Gives the segments of a plain label map the names and colours of their labels, those of coloured pictures
/// the names of their colours; those that the table does not know keep theirs, and of two with one name the
/// later has its number behind it. Throws ImagingError for a segmentation that names its segments itself.
void name_segments(Segmentation& segmentation, const ColourTable& table);

/// The segment of that name, blanks and underscores being alike; in a plain label map also of that number.
/// Throws ImagingError, with the nearest name, if there is none.
const Segment& segment_named(const Segmentation& segmentation, const std::string& name);

}  // namespace osteomill
