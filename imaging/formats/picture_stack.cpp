#include "imaging/formats/picture_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/text/words.h"
#include "imaging/formats/desktop_file.h"
#include "imaging/formats/picture_file.h"
#include "imaging/formats/picture_order.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

struct Page {
    std::filesystem::path file;
    int number = -1;  ///< a TIFF's page; -1: a PNG
};

std::string lower_extension(const std::filesystem::path& path) {
    return lower_case(path.extension().string());
}

bool is_tiff_name(const std::filesystem::path& path) {
    return lower_extension(path) == ".tif" || lower_extension(path) == ".tiff";
}

std::vector<std::filesystem::path> picture_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
        if (!is_of_the_desktop(entry.path()) &&
            (is_tiff_name(entry.path()) || lower_extension(entry.path()) == ".png"))
            files.push_back(entry.path());
    sort_by_numbers(files);
    return files;
}

std::vector<Page> pages_of(const std::vector<std::filesystem::path>& files) {
    std::vector<Page> pages;
    for (const auto& file : files) {
        if (lower_extension(file) == ".png") {
            pages.push_back({file});
            continue;
        }
        const int count = TiffPages(file).count();
        for (int page = 0; page < count; ++page) pages.push_back({file, page});
    }
    return pages;
}

/// Reads one page after the other; a TIFF of several is opened once.
class PageReader {
  public:
    explicit PageReader(ImagePurpose purpose) : purpose_(purpose) {}

    SlicePicture read(const Page& page) {
        if (page.number < 0) return read_png_slice(page.file);
        if (!tiff_ || page.file != open_) tiff_.emplace(page.file);
        open_ = page.file;
        return tiff_->read(page.number, purpose_);
    }

  private:
    ImagePurpose purpose_;
    std::filesystem::path open_;
    std::optional<TiffPages> tiff_;
};

}  // namespace

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
                                                         }) < 2 * pictures);
}

OpenedImage open_picture_stack(const std::filesystem::path& path, const std::optional<glm::dvec3>& spacing_mm,
                               ImagePurpose purpose) {
    const std::vector<std::filesystem::path> files =
        std::filesystem::is_directory(path) ? picture_files(path) : std::vector{path};
    std::vector<Page> pages = pages_of(files);
    if (pages.size() < 2)
        throw ImagingError(path,
                           "is no stack of pictures: a folder with a PNG or TIFF for each slice, or a TIFF "
                           "of several pages");
    if (!spacing_mm)
        throw ImagingError(path,
                           "is a stack of pictures, which do not say how far their pixels are apart; give "
                           "--stack-spacing x,y,z in mm");
    const SlicePicture first = PageReader(purpose).read(pages.front());
    OpenedImage stack{.is_coloured = first.is_coloured};
    SourceImage& image = stack.image;
    image.size_voxels = {first.width, first.height, static_cast<int>(pages.size())};
    image.spacing_mm = *spacing_mm;
    image.notes.push_back(
        fmt::format("{}: pictures say nothing of orientation: left and right are a guess (columns to the "
                    "left, rows to the back, slices up)",
                    path.string()));
    for (const std::string& note : {doubt_of_order(files), first.note})
        if (!note.empty()) image.notes.push_back(note);
    said_of(path, [&] { require_plausible_geometry(image); });
    stack.reading_bytes = 2 * sizeof(float) * first.values.size();
    stack.read_slices = [pages = std::move(pages), size = image.size_voxels, is_coloured = first.is_coloured,
                         purpose](const TakeSlice& take, const ReportProgress& report) {
        PageReader reader(purpose);
        for (int k = 0; k < size.z; ++k) {
            const Page& page = pages[static_cast<std::size_t>(k)];
            SlicePicture picture = reader.read(page);
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
