// Labels of an image's voxels, kept as runs of equal labels along its rows: a label map is mostly such, and a
// structure is found in it without looking at every voxel.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace osteomill {

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

}  // namespace osteomill
