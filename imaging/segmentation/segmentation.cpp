#include "imaging/segmentation/segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "common/scene/nearest_name.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"
#include "imaging/bone_file/digest.h"
#include "imaging/formats/image_reader.h"
#include "imaging/imaging_error.h"

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

namespace {

constexpr std::size_t most_runs = std::size_t{1} << 28U;  // 2 GiB
constexpr int most_segments = 4096;
constexpr float most_off_whole = 0.01F;

using KeyValues = std::map<std::string, std::string>;

/// "0.5 1 0", as Slicer writes colours; nothing for anything else.
std::optional<std::array<std::uint8_t, 3>> colour_of(const std::string& text) {
    std::istringstream words(text);
    words.imbue(std::locale::classic());
    std::array<std::uint8_t, 3> colour{};
    for (std::uint8_t& channel : colour) {
        double part = 0.0;
        if (!(words >> part) || !(part >= 0.0 && part <= 1.0)) return std::nullopt;
        channel = static_cast<std::uint8_t>(std::lround(255.0 * part));
    }
    return colour;
}

/// Segments that the header names; empty for a plain label map. Versions of 3D Slicer before 4.11 write
/// neither layer nor label: each segment has a layer of its own.
std::vector<Segment> named_segments(const std::filesystem::path& path, const OpenedImage& labels) {
    const KeyValues& keys = labels.key_values;
    const auto value = [&](int segment, const char* what) -> std::optional<std::string> {
        const auto found = keys.find(fmt::format("Segment{}_{}", segment, what));
        return found == keys.end() ? std::nullopt : std::optional(found->second);
    };
    const auto number = [&](int segment, const char* what, int fallback, int low, int high) {
        const std::optional<std::string> text = value(segment, what);
        const std::optional<int> whole = text ? parse_number<int>(trimmed(*text)) : fallback;
        if (!whole || *whole < low || *whole > high)
            throw ImagingError(
                path, fmt::format("Segment{}_{} '{:.40}' is no whole number from {} to {}", segment, what,
                                  text ? *text : std::to_string(fallback), low, high));
        return *whole;
    };
    std::vector<Segment> segments;
    std::map<int, int> segments_of_layer;
    for (int i = 0; i < most_segments; ++i) {
        // Numbers may have gaps, if a program took one out.
        const bool is_there = value(i, "Name") || value(i, "ID");
        if (!is_there) continue;
        std::string name = value(i, "Name").value_or("");
        if (trimmed(name).empty()) name = value(i, "ID").value_or("");
        const int next = static_cast<int>(segments.size());
        const int layer = number(i, "Layer", labels.layers > 1 ? next : 0, 0, labels.layers - 1);
        const int label = number(i, "LabelValue", ++segments_of_layer[layer], 0, 65535);
        if (label == 0) continue;  // the background, as some list it
        const std::optional<std::string> colour = value(i, "Color");
        segments.push_back({.name = trimmed(name).empty() ? std::to_string(label) : name,
                            .layer = layer,
                            .label = static_cast<std::uint16_t>(label),
                            .colour_rgb = colour ? colour_of(*colour) : std::nullopt});
    }
    return segments;
}

LabelRows read_labels(const std::filesystem::path& path, const OpenedImage& opened) {
    constexpr float rounding_of_floats = 1e-7F;
    LabelRows rows(opened.image.size_voxels, opened.layers);
    std::vector<std::uint16_t> row(static_cast<std::size_t>(opened.image.size_voxels.x) *
                                   static_cast<std::size_t>(opened.layers));
    std::vector<bool> seen(65536);
    int different = 0;
    const auto label_of = [&](float value) {
        // Slope and intercept leave a label short of whole.
        const float whole = std::nearbyint(value);
        if (!(whole >= 0.0F && whole <= 65535.0F &&
              std::abs(value - whole) <= most_off_whole + rounding_of_floats * whole))
            throw ImagingError(
                path, fmt::format("is no label map: it holds {}, no whole number from 0 to 65535", value));
        const auto label = static_cast<std::uint16_t>(whole);
        if (!seen[label]) {
            seen[label] = true;
            if (++different > most_segments + 1)
                throw ImagingError(path, "is no label map: it holds more than 4096 different values");
        }
        return label;
    };
    opened.read_slices(
        [&](int, std::span<float> slice) {
            for (; !slice.empty(); slice = slice.subspan(row.size())) {
                std::ranges::transform(slice.first(row.size()), row.begin(), label_of);
                rows.add_row(row);
            }
            if (rows.runs() > most_runs)
                throw ImagingError(path, "changes its label too often to be kept; crop it in 3D Slicer");
        },
        [](double) {});
    return rows;
}

/// One line on labels that no segment has; empty if each has one.
std::string labels_left_out(const Segmentation& segmentation) {
    int left_out = 0;
    for (int layer = 0; layer < segmentation.labels.layers(); ++layer)
        for (const std::uint16_t label : segmentation.labels.labels_in(layer))
            left_out += std::ranges::none_of(segmentation.segments, [&](const Segment& segment) {
                return segment.layer == layer && segment.label == label;
            });
    if (left_out == 0) return {};
    return fmt::format("{}: {} of its labels are none of its segments'; left out", segmentation.path.string(),
                       left_out);
}

/// The segments of a label map without names.
std::vector<Segment> numbered_segments(const LabelRows& labels) {
    std::vector<Segment> segments;
    for (const std::uint16_t label : labels.labels_in(0))
        segments.push_back({.name = std::to_string(label), .layer = 0, .label = label, .colour_rgb = {}});
    return segments;
}

void require_plain_names(const Segmentation& segmentation) {
    for (std::size_t i = 0; i < segmentation.segments.size(); ++i) {
        const std::string& name = segmentation.segments[i].name;
        if (const auto why = why_not_plain(name))
            throw ImagingError(segmentation.path, fmt::format("the name of its segment {}, \"{}\", {}", i,
                                                              one_line(name), *why));
    }
}

void require_distinct_names(const Segmentation& segmentation) {
    std::set<std::string> names;
    for (const Segment& segment : segmentation.segments)
        if (!names.insert(segment.name).second)
            throw ImagingError(segmentation.path,
                               fmt::format("has two segments called \"{}\"", segment.name));
}

/// Coloured pictures with numbers in place of colours, in the order in which the colours come.
OpenedImage numbered(const OpenedImage& coloured, const std::filesystem::path& path,
                     std::map<std::uint32_t, std::uint16_t>& label_of_colour) {
    OpenedImage labels = coloured;
    labels.read_slices = [&](const TakeSlice& take, const ReportProgress& report) {
        coloured.read_slices(
            [&](int k, std::span<float> slice) {
                for (float& value : slice) {
                    if (value == 0.0F) continue;
                    const auto next = static_cast<std::uint16_t>(label_of_colour.size() + 1);
                    value = label_of_colour.emplace(static_cast<std::uint32_t>(value), next).first->second;
                    if (next > most_segments + 1)
                        throw ImagingError(path, "is no label map: it holds more than 4096 colours");
                }
                take(k, slice);
            },
            report);
    };
    return labels;
}

std::vector<Segment> coloured_segments(const std::map<std::uint32_t, std::uint16_t>& label_of_colour) {
    std::vector<Segment> segments;
    for (const auto& [colour, label] : label_of_colour)
        segments.push_back({.name = fmt::format("#{:06x}", colour),
                            .label = label,
                            .colour_rgb = std::array{static_cast<std::uint8_t>(colour >> 16U),
                                                     static_cast<std::uint8_t>(colour >> 8U),
                                                     static_cast<std::uint8_t>(colour)}});
    return segments;
}

}  // namespace

Segmentation read_segmentation(const std::filesystem::path& path,
                               const std::optional<glm::dvec3>& stack_spacing_mm) {
    const OpenedImage found = open_labels(path, {.stack_spacing_mm = stack_spacing_mm});
    if (std::filesystem::is_regular_file(path)) has_file_digest(path);  // or it is damaged
    Segmentation segmentation{.path = path,
                              .image = found.image,
                              .segments = named_segments(path, found),
                              .is_plain_map = false,
                              .is_by_colour = found.is_coloured,
                              .labels = {}};
    if (segmentation.segments.empty() && found.layers > 1)
        throw ImagingError(path, "has layers, but names no segments (Segment0_Name)");
    require_distinct_names(segmentation);
    std::map<std::uint32_t, std::uint16_t> label_of_colour;
    segmentation.labels =
        read_labels(path, found.is_coloured ? numbered(found, path, label_of_colour) : found);
    segmentation.is_plain_map = segmentation.segments.empty();
    if (segmentation.is_plain_map)
        segmentation.segments =
            found.is_coloured ? coloured_segments(label_of_colour) : numbered_segments(segmentation.labels);
    // TotalSegmentator writes a file for each structure.
    if (segmentation.is_plain_map && !found.is_coloured && segmentation.segments.size() == 1)
        segmentation.segments.front().name = name_without_ending(path);
    require_plain_names(segmentation);
    if (const std::string note = labels_left_out(segmentation); !note.empty())
        segmentation.image.notes.push_back(note);
    return segmentation;
}

void name_segments(Segmentation& segmentation, const ColourTable& table) {
    if (!segmentation.is_plain_map)
        throw ImagingError(segmentation.path,
                           "names its segments itself; a colour table is for plain label maps");
    std::set<std::string> names;
    for (Segment& segment : segmentation.segments) {
        const auto found =
            segmentation.is_by_colour
                ? std::ranges::find_if(
                      table, [&](const auto& row) { return row.second.colour_rgb == segment.colour_rgb; })
                : table.find(segment.label);
        if (found != table.end()) {
            segment.name = found->second.name;
            segment.colour_rgb = found->second.colour_rgb;
        }
        if (!names.insert(segment.name).second) segment.name += fmt::format(" ({})", segment.label);
    }
}

const Segment& segment_named(const Segmentation& segmentation, const std::string& name) {
    std::vector<std::string> names;
    for (const Segment& segment : segmentation.segments) names.push_back(segment.name);
    const std::optional<std::string> same = same_name(name, names);
    for (const Segment& segment : segmentation.segments)
        if (segment.name == same || (segmentation.is_plain_map && std::to_string(segment.label) == name))
            return segment;
    const std::optional<std::string> nearest = nearest_name(name, names);
    throw ImagingError(
        segmentation.path,
        fmt::format("has no segment \"{}\"{}", name,
                    nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : std::string()));
}

}  // namespace osteomill
