#include "imaging/formats/nrrd_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string_view>

#include "common/text/words.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::uint64_t most_layers = 255;

/// The numbers of "(a,b,c) (d,e,f)" or "a b c", one list per word; a word that is no number gives NaN.
std::vector<std::vector<double>> numbers_of_words(std::string text) {
    // Blanks within parentheses belong to the word.
    bool inside = false;
    std::erase_if(text, [&](char c) {
        if (c == '(') inside = true;
        if (c == ')') inside = false;
        return inside && c == ' ';
    });
    std::vector<std::vector<double>> words;
    std::istringstream line(text);
    for (std::string word; line >> word;) {
        std::replace_if(
            word.begin(), word.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
        std::istringstream parts(word);
        std::vector<double> numbers;
        for (std::string part; parts >> part;) numbers.push_back(real_number(part).value_or(std::nan("")));
        words.push_back(numbers);
    }
    return words;
}

/// How coordinates of a space become left, posterior, superior.
struct NrrdSpace {
    std::size_t dimension = 3;
    glm::dvec3 signs{1.0};
    bool is_anatomical = false;
};

/// "left-posterior-superior", "LPS", with time behind or not; coordinates that are not the patient's.
NrrdSpace space_of(const NrrdHeader& header, const std::filesystem::path& path) {
    NrrdSpace space;
    const auto refuse = [&](const char* name) {
        throw ImagingError(path, fmt::format("{} '{}' is not read; left-posterior-superior (LPS), "
                                             "right-anterior-superior (RAS) and the like are",
                                             name, shortened(*header.field(name))));
    };
    if (const auto dimension = header.field("space dimension")) {
        space.dimension = parse_number<std::size_t>(*dimension).value_or(0);
        if (space.dimension < 3 || space.dimension > 4) refuse("space dimension");
    }
    if (!header.fields.contains("space")) return space;
    std::string name = lower_case(*header.field("space"));
    for (const char* without_patient : {"scanner-xyz", "3d-right-handed", "3d-left-handed"})
        if (name.starts_with(without_patient)) {
            space.dimension = name.ends_with("-time") ? 4 : 3;
            return space;
        }
    for (const auto& [word, letter] :
         {std::pair{"left-", "l"}, std::pair{"right-", "r"}, std::pair{"anterior-", "a"},
          std::pair{"posterior-", "p"}, std::pair{"superior", "s"}, std::pair{"inferior", "i"},
          std::pair{"-time", "t"}})
        if (const std::size_t at = name.find(word); at != std::string::npos)
            name.replace(at, std::string_view(word).size(), letter);
    space.is_anatomical = true;
    space.dimension = name.size();
    if ((name.size() != 3 && !(name.size() == 4 && name[3] == 't')) || (name[0] != 'l' && name[0] != 'r') ||
        (name[1] != 'p' && name[1] != 'a') || (name[2] != 's' && name[2] != 'i'))
        refuse("space");
    space.signs = {name[0] == 'l' ? 1.0 : -1.0, name[1] == 'p' ? 1.0 : -1.0, name[2] == 's' ? 1.0 : -1.0};
    return space;
}

/// The length of one unit in millimetres for each of `count` axes, from a field of quoted names.
std::vector<double> mm_of_units(const NrrdHeader& header, const char* name, std::size_t count,
                                const std::filesystem::path& path, SourceImage& image) {
    std::vector<double> mm(count, 1.0);
    const std::optional<std::string> text = header.field(name);
    if (!text) return mm;
    std::vector<std::string> units;
    const bool is_quoted = text->find('"') != std::string::npos;
    for (std::size_t at = 0; is_quoted && (at = text->find('"', at)) != std::string::npos;) {
        const std::size_t end = std::min(text->find('"', at + 1), text->size());
        units.push_back(text->substr(at + 1, end - at - 1));
        at = end + 1;
    }
    if (!is_quoted) units = words_of(*text);
    for (std::size_t i = 0; i < std::min(count, units.size()); ++i) {
        if (is_unknown_unit(units[i])) continue;
        const std::optional<double> known = mm_of_unit(units[i]);
        // The unit of an axis of time or of a list is no unit of length.
        if (!known && i < 3)
            throw ImagingError(path, fmt::format("{} '{}': {}", name, shortened(*text), known_units));
        mm[i] = known.value_or(1.0);
    }
    if (std::any_of(mm.begin(), mm.end(), [](double one) { return one != 1.0; }))
        image.notes.push_back(
            fmt::format("{}: its {} are {}; converted to mm", path.string(), name, shortened(*text)));
    return mm;
}

/// An axis of the file. Without a step it is no axis of space.
struct NrrdAxis {
    std::uint64_t size = 0;
    std::optional<glm::dvec3> step_mm{};  ///< patient LPS
};

bool is_kind_of_space(const std::string& kind) {
    const std::string name = lower_case(kind);
    return name == "domain" || name == "space" || name == "none" || name.starts_with('?');
}

std::vector<NrrdAxis> axes_by_directions(const NrrdHeader& header, const NrrdSpace& space,
                                         const std::vector<std::uint64_t>& sizes,
                                         const std::vector<double>& mm, const std::filesystem::path& path) {
    const std::string text = *header.field("space directions");
    const auto words = numbers_of_words(text);
    const auto refuse = [&](const std::string& reason) {
        throw ImagingError(path, fmt::format("space directions '{}': {}", shortened(text), reason));
    };
    if (words.size() != sizes.size())
        refuse(fmt::format("{} axes need as many vectors, or none", sizes.size()));
    std::vector<NrrdAxis> axes;
    for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
        axes.push_back({.size = sizes[axis]});
        if (words[axis].size() == 1 && std::isnan(words[axis][0]) && sizes.size() > 3) continue;
        if (words[axis].size() != space.dimension)
            refuse(fmt::format("vectors of {} numbers are expected", space.dimension));
        glm::dvec3 step(0.0);
        for (int row = 0; row < 3; ++row)
            step[row] = words[axis][static_cast<std::size_t>(row)] * mm[static_cast<std::size_t>(row)];
        if (space.dimension == 4 && step == glm::dvec3(0.0)) continue;  // time
        const double length_mm = glm::length(step);
        if (!(length_mm > 0.0) || !std::isfinite(length_mm) || length_mm > farthest_position_mm)
            refuse("every axis needs a spacing in mm that is a number above 0");
        axes.back().step_mm = space.signs * step;
    }
    return axes;
}

/// The axes if the header states only spacings, or nothing: they run along the space's own.
std::vector<NrrdAxis> axes_by_spacings(const NrrdHeader& header, const NrrdSpace& space,
                                       const std::vector<std::uint64_t>& sizes, SourceImage& image,
                                       const std::filesystem::path& path) {
    const std::vector<std::string> kinds = words_of(header.field("kinds").value_or(""));
    const std::optional<std::string> text = header.field("spacings");
    if (!text && (header.fields.contains("axis mins") || header.fields.contains("axis maxs")))
        throw ImagingError(path,
                           "says where its axes begin and end (axis mins, axis maxs) and no spacings; "
                           "save it with spacings or space directions");
    if (!text) image.notes.push_back(path.string() + ": its header has no spacing; taken as 1 mm");
    const auto words = numbers_of_words(text.value_or(""));
    const std::vector<double> mm = mm_of_units(header, "units", sizes.size(), path, image);
    std::vector<NrrdAxis> axes;
    int placed = 0;
    for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
        axes.push_back({.size = sizes[axis]});
        const double spacing =
            !text ? 1.0 : (axis < words.size() && words[axis].size() == 1 ? words[axis][0] : 0.0);
        const bool is_of_space = (axis >= kinds.size() || is_kind_of_space(kinds[axis])) &&
                                 !(std::isnan(spacing) && sizes.size() > 3);
        if (!is_of_space) continue;
        if (!(spacing > 0.0) || !std::isfinite(spacing))
            throw ImagingError(
                path, fmt::format("spacings '{}': every axis needs a spacing in mm that is a number above 0",
                                  shortened(text.value_or(""))));
        glm::dvec3 step(0.0);
        if (placed < 3) step[placed] = space.signs[placed] * spacing * mm[axis];
        axes.back().step_mm = step;
        ++placed;
    }
    return axes;
}

/// Leaves out axes of a single voxel that are not of space, or are more than space has; the layers go before.
void place(std::vector<NrrdAxis> axes, ImageHeader& into, const std::filesystem::path& path) {
    std::erase_if(axes, [](const NrrdAxis& axis) { return axis.size == 1 && !axis.step_mm; });
    while (axes.size() > 3 && axes.back().size == 1) axes.pop_back();
    if (axes.size() > 1 && !axes.front().step_mm) {
        if (axes.front().size > most_layers) throw ImagingError(path, "has more than 255 layers");
        into.layers = static_cast<int>(axes.front().size);
        axes.erase(axes.begin());
    }
    if (axes.size() != 3 ||
        std::any_of(axes.begin(), axes.end(), [](const NrrdAxis& axis) { return !axis.step_mm; }))
        throw ImagingError(path, fmt::format("has {} dimensions; a volume has 3", axes.size()));
    for (int axis = 0; axis < 3; ++axis) {
        const NrrdAxis& from = axes[static_cast<std::size_t>(axis)];
        into.image.size_voxels[axis] = static_cast<int>(from.size);
        into.image.spacing_mm[axis] = glm::length(*from.step_mm);
        into.image.direction[axis] = *from.step_mm / into.image.spacing_mm[axis];
    }
}

}  // namespace

void read_nrrd_geometry(const NrrdHeader& header, const std::vector<std::uint64_t>& sizes, ImageHeader& into,
                        const std::filesystem::path& path) {
    const NrrdSpace space = space_of(header, path);
    const bool has_directions = header.fields.contains("space directions");
    const std::vector<double> mm = mm_of_units(header, "space units", space.dimension, path, into.image);
    place(has_directions ? axes_by_directions(header, space, sizes, mm, path)
                         : axes_by_spacings(header, space, sizes, into.image, path),
          into, path);
    if (const std::optional<std::string> text = header.field("space origin")) {
        const auto words = numbers_of_words(*text);
        if (words.size() != 1 || words[0].size() != space.dimension)
            throw ImagingError(path, fmt::format("space origin '{}': a vector of {} numbers is expected",
                                                 shortened(*text), space.dimension));
        for (int row = 0; row < 3; ++row) {
            const auto i = static_cast<std::size_t>(row);
            into.image.origin_mm[row] = space.signs[row] * words[0][i] * mm[i];
        }
        if (!is_plausible_position(into.image.origin_mm))
            throw ImagingError(path,
                               implausible_position(fmt::format("space origin '{}'", shortened(*text))));
    }
    into.is_placed = space.is_anatomical && has_directions;
    if (!into.is_placed)
        note_guessed_orientation(
            into.image, path,
            header.fields.contains("space")
                ? "its header says only 'space: " + shortened(*header.field("space")) + "'"
                : "its header says nothing of orientation");
    settle_geometry(into.image, path);
}

}  // namespace osteomill
