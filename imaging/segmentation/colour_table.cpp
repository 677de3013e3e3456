#include "imaging/segmentation/colour_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "common/files/input_file.h"
#include "common/text/csv.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::uint64_t most_table_bytes = 1'000'000;
constexpr int highest_label = 65535;

/// A line of the table; nothing for a line of another form.
struct LabelLine {
    int label = 0;
    ColourOfLabel colour{};
};

std::optional<int> number_up_to(const std::string& text, int most) {
    const auto number = parse_number<int>(trimmed(text));
    return number && *number >= 0 && *number <= most ? number : std::nullopt;
}

std::optional<LabelLine> line_of(const std::string& label, const std::string& name,
                                 const std::array<std::string, 3>& colour) {
    LabelLine line{.label = 0, .colour = {.name = trimmed(name)}};
    const std::optional<int> number = number_up_to(label, highest_label);
    if (!number) return std::nullopt;
    line.label = *number;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<int> part = number_up_to(colour[i], 255);
        if (!part) return std::nullopt;
        line.colour.colour_rgb[i] = static_cast<std::uint8_t>(*part);
    }
    return line;
}

/// LABEL R G B A VISIBLE MESH "NAME"
std::optional<LabelLine> itk_snap_line(const std::string& line) {
    const std::vector<std::string> words = words_of(line);
    const std::size_t begin = line.find('"');
    const std::size_t end = line.rfind('"');
    if (begin == std::string::npos || end == begin || words.size() < 8) return std::nullopt;
    return line_of(words[0], line.substr(begin + 1, end - begin - 1), {words[1], words[2], words[3]});
}

/// LABEL NAME R G B A; the name's blanks are underscores, or blanks. FreeSurfer 8 has one number more, of few
/// kinds of tissue, where a name that ends in a number would have its alpha.
std::optional<LabelLine> ctbl_line(const std::string& line) {
    constexpr int highest_kind = 15;
    std::vector<std::string> words = words_of(line);
    if (words.size() == 7 && number_up_to(words[2], 255) && number_up_to(words[6], highest_kind))
        words.pop_back();
    if (words.size() < 5) return std::nullopt;
    const std::size_t numbers = words.size() >= 6 ? 4 : 3;  // alpha may be missing
    std::string name = words[1];
    for (std::size_t i = 2; i + numbers < words.size(); ++i) name += " " + words[i];
    std::ranges::replace(name, '_', ' ');
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    const auto colour = words.end() - static_cast<std::ptrdiff_t>(numbers);
    return line_of(words[0], name, {colour[0], colour[1], colour[2]});
}

/// The columns of a table in CSV. The defaults are those of 3D Slicer's tables.
struct CsvColumns {
    char separator = ',';
    std::array<std::size_t, 5> at{};

    static std::optional<CsvColumns> of_header(const std::string& line) {
        constexpr std::array<std::string_view, 5> names{"labelvalue", "name", "color_r", "color_g",
                                                        "color_b"};
        CsvColumns columns{.separator = line.find(';') == std::string::npos ? ',' : ';'};
        const std::vector<std::string> cells = quoted_cells(line, columns.separator);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const auto found = std::ranges::find_if(
                cells, [&](const std::string& cell) { return lower_case(trimmed(cell)) == names[i]; });
            if (found == cells.end()) return std::nullopt;
            columns.at[i] = static_cast<std::size_t>(found - cells.begin());
        }
        return columns;
    }
    std::optional<LabelLine> line(const std::string& line) const {
        const std::vector<std::string> cells = quoted_cells(line, separator);
        if (std::ranges::max(at) >= cells.size()) return std::nullopt;
        return line_of(cells[at[0]], cells[at[1]], {cells[at[2]], cells[at[3]], cells[at[4]]});
    }
};

}  // namespace

ColourTable read_colour_table(const std::filesystem::path& path) {
    std::string text = read_text(path, {"a colour table", most_table_bytes});
    // Old programs of the Macintosh end lines so.
    if (text.find('\n') == std::string::npos) std::ranges::replace(text, '\r', '\n');
    std::istringstream in(std::move(text));
    ColourTable table;
    std::optional<CsvColumns> columns;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        try {
            strip_line(line, ++number == 1);
        } catch (const std::runtime_error& error) {
            throw ImagingError(path, error.what());
        }
        if (trimmed(line).empty() || trimmed(line).starts_with('#')) continue;
        if (!columns && table.empty() && (columns = CsvColumns::of_header(line))) continue;
        std::optional<LabelLine> found = columns ? columns->line(line) : itk_snap_line(line);
        if (!found && !columns) found = ctbl_line(line);
        if (!found)
            throw ImagingError(
                path,
                fmt::format(
                    "line {}: is no line of a colour table; expected LABEL NAME R G B A (3D Slicer's .ctbl), "
                    "LABEL R G B A V M \"NAME\" (ITK-SNAP), or a .csv with the columns LabelValue, Name, "
                    "Color_R, Color_G and Color_B",
                    number));
        if (found->colour.name == "(none)" || found->colour.name.empty()) continue;
        if (const auto why = why_not_plain(found->colour.name))
            throw ImagingError(path, fmt::format("line {}: the name of its label {}", number, *why));
        if (!table.emplace(static_cast<std::uint16_t>(found->label), found->colour).second)
            throw ImagingError(path, fmt::format("line {}: label {} comes twice", number, found->label));
    }
    if (table.empty()) throw ImagingError(path, "is no colour table: it names no label");
    return table;
}

}  // namespace osteomill
