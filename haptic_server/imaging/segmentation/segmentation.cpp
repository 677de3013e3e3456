#include "haptic_server/imaging/segmentation/segmentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <locale>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>

#include "common/scene/nearest_name.h"
#include "haptic_server/imaging/formats/image_reader.h"
#include "haptic_server/imaging/formats/nrrd_header.h"
#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::uint64_t most_labels = std::uint64_t{1} << 31U;
constexpr int most_segments = 4096;

using KeyValues = std::map<std::string, std::string, std::less<>>;

/// "key:=value" lines of a NRRD's header.
KeyValues key_values_of(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = RegularFile(path).first_bytes(most_nrrd_header_bytes);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    KeyValues found;
    if (!text.starts_with("NRRD")) return found;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (line.empty()) break;
        const std::size_t at = line.find(":=");
        if (at != std::string_view::npos && !line.starts_with('#'))
            found.emplace(line.substr(0, at), line.substr(at + 2));
    }
    return found;
}

std::optional<int> whole_number(std::string_view text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

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

/// Segments that the header names; empty for a plain label map.
std::vector<Segment> named_segments(const std::filesystem::path& path, int layers) {
    const KeyValues keys = key_values_of(path);
    std::vector<Segment> segments;
    const auto number = [&](int segment, const char* what, int fallback, int low, int high) {
        const auto found = keys.find(fmt::format("Segment{}_{}", segment, what));
        if (found == keys.end()) return fallback;
        const std::optional<int> value = whole_number(found->second);
        if (!value || *value < low || *value > high)
            throw ImagingError(path, fmt::format("Segment{}_{} '{:.40}' is no whole number from {} to {}",
                                                 segment, what, found->second, low, high));
        return *value;
    };
    for (int i = 0; i < most_segments; ++i) {
        auto name = keys.find(fmt::format("Segment{}_Name", i));
        if (name == keys.end()) name = keys.find(fmt::format("Segment{}_ID", i));
        if (name == keys.end()) break;
        const auto colour = keys.find(fmt::format("Segment{}_Color", i));
        segments.push_back({.name = name->second,
                            .layer = number(i, "Layer", 0, 0, layers - 1),
                            .label = static_cast<std::uint16_t>(number(i, "LabelValue", 1, 1, 65535)),
                            .colour_rgb = colour == keys.end() ? std::nullopt : colour_of(colour->second)});
    }
    return segments;
}

void read_labels(const OpenedImage& opened, Segmentation& into) {
    const std::uint64_t count = voxel_count(into.image) * static_cast<std::uint64_t>(into.layers);
    if (count > most_labels)
        throw ImagingError(into.path,
                           fmt::format("has {} labels, more than 2^31; crop it in 3D Slicer", count));
    into.labels.reserve(count);
    opened.read_slices(
        [&](int, std::span<float> slice) {
            for (const float value : slice) {
                if (!(value >= 0.0F && value <= 65535.0F) || value != std::floor(value))
                    throw ImagingError(
                        into.path,
                        fmt::format("is no label map: it holds {}, no whole number from 0 to 65535", value));
                into.labels.push_back(static_cast<std::uint16_t>(value));
            }
        },
        [](double) {});
}

/// Of a label map without names.
std::vector<Segment> numbered_segments(const Segmentation& segmentation) {
    std::vector<bool> seen(65536);
    for (const std::uint16_t label : segmentation.labels) seen[label] = true;
    std::vector<Segment> segments;
    for (std::size_t label = 1; label < seen.size(); ++label) {
        if (!seen[label]) continue;
        if (segments.size() == most_segments)
            throw ImagingError(segmentation.path,
                               "is no label map: it holds more than 4096 different values");
        segments.push_back({.name = std::to_string(label),
                            .layer = 0,
                            .label = static_cast<std::uint16_t>(label),
                            .colour_rgb = {}});
    }
    return segments;
}

}  // namespace

Segmentation read_segmentation(const std::filesystem::path& path) {
    const OpenedLabels found = open_labels(path);
    Segmentation segmentation{.path = path,
                              .image = found.opened.image,
                              .layers = found.layers,
                              .segments = {},
                              .is_plain_map = false,
                              .labels = {}};
    segmentation.segments = named_segments(path, found.layers);
    if (segmentation.segments.empty() && found.layers > 1)
        throw ImagingError(path, "has layers, but names no segments (Segment0_Name)");
    std::set<std::string> names;
    for (const Segment& segment : segmentation.segments)
        if (!names.insert(segment.name).second)
            throw ImagingError(path, fmt::format("has two segments called \"{}\"", segment.name));
    read_labels(found.opened, segmentation);
    segmentation.is_plain_map = segmentation.segments.empty();
    if (segmentation.is_plain_map) segmentation.segments = numbered_segments(segmentation);
    return segmentation;
}

void name_segments(Segmentation& segmentation, const ColourTable& table) {
    if (!segmentation.is_plain_map)
        throw ImagingError(segmentation.path,
                           "names its segments itself; a colour table is for plain label maps");
    for (Segment& segment : segmentation.segments) {
        const auto found = table.find(segment.label);
        if (found == table.end()) continue;
        segment.name = found->second.name;
        segment.colour_rgb = found->second.colour_rgb;
    }
}

const Segment& segment_named(const Segmentation& segmentation, const std::string& name) {
    std::vector<std::string> names;
    for (const Segment& segment : segmentation.segments) {
        if (segment.name == name) return segment;
        names.push_back(segment.name);
    }
    const std::optional<std::string> nearest = nearest_name(name, names);
    throw ImagingError(
        segmentation.path,
        fmt::format("has no segment \"{}\"{}", name,
                    nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : std::string()));
}

}  // namespace osteomill
