#include "imaging/segmentation/label_rows.h"

#include <algorithm>

namespace osteomill {

LabelRows::LabelRows(const glm::ivec3& size_voxels, int layers)
    : size_(size_voxels), by_layer_(static_cast<std::size_t>(layers)) {}

void LabelRows::add_row(std::span<const std::uint16_t> labels) {
    const std::size_t layers = by_layer_.size();
    for (std::size_t layer = 0; layer < layers; ++layer) {
        Layer& into = by_layer_[layer];
        for (std::size_t i = layer; i < labels.size();) {
            const std::uint16_t label = labels[i];
            do i += layers;
            while (i < labels.size() && labels[i] == label);
            into.runs.push_back({static_cast<std::int32_t>((i - layer) / layers), label});
        }
        into.end_of_row.push_back(into.runs.size());
    }
}

std::span<const LabelRows::Run> LabelRows::row(int layer, int j, int k) const {
    const Layer& from = by_layer_[static_cast<std::size_t>(layer)];
    const std::size_t number =
        static_cast<std::size_t>(j) + static_cast<std::size_t>(size_.y) * static_cast<std::size_t>(k);
    const std::size_t first = number == 0 ? 0 : from.end_of_row[number - 1];
    return std::span(from.runs).subspan(first, from.end_of_row[number] - first);
}

std::uint16_t LabelRows::at(int layer, const glm::ivec3& voxel) const {
    const std::span<const Run> runs = row(layer, voxel.y, voxel.z);
    return std::ranges::upper_bound(runs, voxel.x, {}, &Run::end)->label;
}

std::vector<std::uint16_t> LabelRows::labels_in(int layer) const {
    std::vector<bool> seen(65536);
    for (const Run& run : by_layer_[static_cast<std::size_t>(layer)].runs) seen[run.label] = true;
    std::vector<std::uint16_t> labels;
    for (std::size_t label = 1; label < seen.size(); ++label)
        if (seen[label]) labels.push_back(static_cast<std::uint16_t>(label));
    return labels;
}

std::size_t LabelRows::runs() const {
    std::size_t sum = 0;
    for (const Layer& layer : by_layer_) sum += layer.runs.size();
    return sum;
}

}  // namespace osteomill
