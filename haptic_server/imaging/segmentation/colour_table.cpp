#include "haptic_server/imaging/segmentation/colour_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <locale>
#include <optional>
#include <set>
#include <sstream>
#include <string_view>
#include <vector>

#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::size_t most_bytes = 1'000'000;

std::optional<int> whole_number(std::string_view text, int most) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || number < 0 || number > most)
        return std::nullopt;
    return number;
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    in.imbue(std::locale::classic());
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

std::optional<std::array<std::uint8_t, 3>> colour_at(const std::vector<std::string>& words,
                                                     std::size_t first) {
    std::array<std::uint8_t, 3> colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<int> part = whole_number(words[first + i], 255);
        if (!part) return std::nullopt;
        colour[i] = static_cast<std::uint8_t>(*part);
    }
    return colour;
}

/// Nothing for a line that is neither form.
std::optional<ColourOfLabel> itk_snap(const std::string& line, const std::vector<std::string>& words) {
    const std::size_t begin = line.find('"');
    const std::size_t end = line.rfind('"');
    if (begin == std::string::npos || end == begin || words.size() < 8) return std::nullopt;
    const auto colour = colour_at(words, 1);
    if (!colour) return std::nullopt;
    return ColourOfLabel{line.substr(begin + 1, end - begin - 1), *colour};
}

std::optional<ColourOfLabel> slicer(const std::vector<std::string>& words) {
    if (words.size() < 5) return std::nullopt;
    const auto colour = colour_at(words, 2);
    if (!colour) return std::nullopt;
    std::string name = words[1];
    std::ranges::replace(name, '_', ' ');
    return ColourOfLabel{name, *colour};
}

}  // namespace

ColourTable read_colour_table(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = RegularFile(path).first_bytes(most_bytes + 1);
    if (bytes.size() > most_bytes) throw ImagingError(path, "is no colour table: it is over a megabyte long");
    std::istringstream in(std::string(bytes.begin(), bytes.end()));
    ColourTable table;
    std::set<std::string> names;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        const std::vector<std::string> words = words_of(line);
        if (words.empty() || words.front().starts_with('#')) continue;
        const auto fail = [&](const std::string& what) {
            return ImagingError(path, fmt::format("line {}: {}", number, what));
        };
        const std::optional<int> label = whole_number(words.front(), 65535);
        std::optional<ColourOfLabel> colour = itk_snap(line, words);
        if (!colour) colour = slicer(words);
        if (!label || !colour)
            throw fail(
                "is no line of a colour table; expected LABEL NAME R G B A (3D Slicer) or LABEL R G B A V M "
                "\"NAME\" (ITK-SNAP)");
        if (!names.insert(colour->name).second)
            throw fail(fmt::format("\"{}\" is named twice", colour->name));
        if (!table.emplace(static_cast<std::uint16_t>(*label), *colour).second)
            throw fail(fmt::format("label {} comes twice", *label));
    }
    if (table.empty()) throw ImagingError(path, "is no colour table: it names no label");
    return table;
}

}  // namespace osteomill
