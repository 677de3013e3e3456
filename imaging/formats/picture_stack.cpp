#include "imaging/formats/picture_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "common/text/words.h"
#include "imaging/formats/picture_file.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

struct Page {
    std::filesystem::path file;
    int number = -1;  ///< of a TIFF; -1: a PNG
};

std::string lower_extension(const std::filesystem::path& path) {
    return lower_case(path.extension().string());
}

bool is_tiff_name(const std::filesystem::path& path) {
    return lower_extension(path) == ".tif" || lower_extension(path) == ".tiff";
}

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

/// Numbers within names by their value: "2" before "10".
bool comes_before(std::string_view a, std::string_view b) {
    while (!a.empty() && !b.empty()) {
        if (!is_digit(a.front()) || !is_digit(b.front())) {
            if (a.front() != b.front()) return a.front() < b.front();
            a.remove_prefix(1);
            b.remove_prefix(1);
            continue;
        }
        const auto take_number = [](std::string_view& text) {
            text.remove_prefix(std::min(text.find_first_not_of('0'), text.size()));
            const std::string_view number =
                text.substr(0, std::ranges::find_if_not(text, is_digit) - text.begin());
            text.remove_prefix(number.size());
            return number;
        };
        const std::string_view one = take_number(a);
        const std::string_view other = take_number(b);
        if (one.size() != other.size()) return one.size() < other.size();
        if (one != other) return one < other;
    }
    return a.size() < b.size();
}

std::vector<std::filesystem::path> picture_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
        if (!is_of_the_desktop(entry.path()) &&
            (is_tiff_name(entry.path()) || lower_extension(entry.path()) == ".png"))
            files.push_back(entry.path());
    std::ranges::sort(files, [](const auto& a, const auto& b) {
        return comes_before(a.filename().string(), b.filename().string());
    });
    return files;
}

std::vector<Page> pages_of(const std::filesystem::path& path) {
    std::vector<Page> pages;
    const bool is_folder = std::filesystem::is_directory(path);
    for (const auto& file : is_folder ? picture_files(path) : std::vector{path}) {
        if (lower_extension(file) == ".png") {
            pages.push_back({file});
            continue;
        }
        const int count = tiff_pages(file);
        for (int page = 0; page < count; ++page) pages.push_back({file, page});
    }
    return pages;
}

SlicePicture read(const Page& page) {
    return page.number < 0 ? read_png_slice(page.file) : read_tiff_slice(page.file, page.number);
}

}  // namespace

bool is_of_the_desktop(const std::filesystem::path& path) {
    const std::string name = lower_case(path.filename().string());
    return name.starts_with('.') || name == "thumbs.db" || name == "desktop.ini";
}

glm::dvec3 parse_stack_spacing(const std::string& text) {
    const auto mm = listed_numbers<3>(text);
    if (!mm || !std::ranges::all_of(*mm, [](double length) { return length > 0.0; }))
        throw std::invalid_argument(
            fmt::format("--stack-spacing '{}': is not x,y,z, three lengths in mm", text));
    return {(*mm)[0], (*mm)[1], (*mm)[2]};
}

bool is_picture_folder(const std::filesystem::path& folder, bool has_spacing) {
    const auto pictures = static_cast<std::ptrdiff_t>(picture_files(folder).size());
    return pictures > 0 && (has_spacing || std::count_if(std::filesystem::directory_iterator(folder), {},
                                                         [](const auto& entry) {
                                                             return !is_of_the_desktop(entry.path());
                                                         }) == pictures);
}

OpenedImage open_picture_stack(const std::filesystem::path& path,
                               const std::optional<glm::dvec3>& spacing_mm) {
    std::vector<Page> pages = pages_of(path);
    if (pages.size() < 2)
        throw ImagingError(path,
                           "is no stack of pictures: a folder with a PNG or TIFF for each slice, or a TIFF "
                           "of several pages");
    if (!spacing_mm)
        throw ImagingError(path,
                           "is a stack of pictures, which do not say how far their pixels are apart; give "
                           "--stack-spacing x,y,z in mm");
    const SlicePicture first = read(pages.front());
    OpenedImage stack{.is_coloured = first.is_coloured};
    SourceImage& image = stack.image;
    image.size_voxels = {first.width, first.height, static_cast<int>(pages.size())};
    image.spacing_mm = *spacing_mm;
    image.notes.push_back(
        fmt::format("{}: pictures say nothing of orientation: left and right are a guess (columns to the "
                    "left, rows to the back, slices up)",
                    path.string()));
    try {
        require_plausible_geometry(image);
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
    stack.reading_bytes = 2 * sizeof(float) * first.values.size();
    stack.read_slices = [pages = std::move(pages), size = image.size_voxels, is_coloured = first.is_coloured](
                            const TakeSlice& take, const ReportProgress& report) {
        for (int k = 0; k < size.z; ++k) {
            const Page& page = pages[static_cast<std::size_t>(k)];
            SlicePicture picture = read(page);
            if (picture.width != size.x || picture.height != size.y || picture.is_coloured != is_coloured)
                throw ImagingError(
                    page.file,
                    fmt::format("is of {} x {} pixels, {}; the first of its stack is of {} x {}, {}",
                                picture.width, picture.height, picture.is_coloured ? "coloured" : "grey",
                                size.x, size.y, is_coloured ? "coloured" : "grey"));
            take(k, picture.values);
            report(static_cast<double>(k + 1) / size.z);
        }
    };
    return stack;
}

}  // namespace osteomill
