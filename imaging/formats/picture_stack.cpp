#include "imaging/formats/picture_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "common/text/words.h"
#include "imaging/formats/desktop_file.h"
#include "imaging/formats/picture_file.h"
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

namespace {

bool is_digit(char letter) {
    return letter >= '0' && letter <= '9';
}

/// Words and a number behind them; the last of a name has none.
struct NamePart {
    std::string words{};
    std::string digits{};    ///< without zeros before them
    std::string fraction{};  ///< the digits behind a point
    bool is_negative = false;
    bool has_number = false;
};

/// How the names of a stack are read; each alone could be read otherwise.
struct Reading {
    bool has_decimals = true;
    std::set<std::string> before_minus{};  ///< words behind which a hyphen is a minus
};

std::string taken_digits(std::string_view& rest) {
    const std::string digits(rest.substr(0, std::ranges::find_if_not(rest, is_digit) - rest.begin()));
    rest.remove_prefix(digits.size());
    return digits;
}

std::vector<NamePart> parts_of(const std::filesystem::path& path, const Reading& reading) {
    const std::string name = lower_case(path.stem().string());
    std::vector<NamePart> parts;
    for (std::string_view rest = name; !rest.empty();) {
        NamePart part;
        part.words = rest.substr(0, std::ranges::find_if(rest, is_digit) - rest.begin());
        rest.remove_prefix(part.words.size());
        part.digits = taken_digits(rest);
        part.has_number = !part.digits.empty();
        part.digits.erase(0, std::min(part.digits.find_first_not_of('0'), part.digits.size()));
        if (reading.has_decimals && rest.size() > 1 && rest[0] == '.' && is_digit(rest[1])) {
            rest.remove_prefix(1);
            part.fraction = taken_digits(rest);
        }
        const std::size_t length = part.words.size();
        const auto is_letter = [](unsigned char one) { return (one >= 'a' && one <= 'z') || one >= 0x80; };
        const bool follows_name =
            length > 1 ? is_letter(static_cast<unsigned char>(part.words[length - 2])) : !parts.empty();
        part.is_negative = part.has_number && part.words.ends_with('-') &&
                           (!follows_name || reading.before_minus.contains(part.words.substr(0, length - 1)));
        if (part.is_negative) part.words.pop_back();
        parts.push_back(part);
    }
    return parts;
}

Reading reading_of(const std::vector<std::filesystem::path>& files) {
    Reading reading;
    std::set<std::string> words;
    std::set<std::size_t> digits_behind_points;
    bool is_counted = false;
    bool is_list = false;  // 1.2.3
    for (const auto& file : files)
        for (const NamePart& part : parts_of(file, {})) {
            if (!part.has_number) continue;
            words.insert(part.words);
            is_list |= part.words == ".";
            if (!part.fraction.empty()) digits_behind_points.insert(part.fraction.size());
            is_counted |= part.fraction.size() > 1 && part.fraction.ends_with('0');
        }
    reading.has_decimals = !is_list && (!is_counted || digits_behind_points.size() < 2);
    for (const std::string& word : words)
        if (words.contains(word + '-')) reading.before_minus.insert(word);
    return reading;
}

/// Compares the numbers of `a` and `b`: below 0, 0 or above 0.
int compared(const NamePart& a, const NamePart& b) {
    if (a.is_negative != b.is_negative) return a.is_negative ? -1 : 1;
    const auto size = [](const NamePart& part) {
        return std::tuple(part.digits.size(), part.digits, part.fraction);
    };
    const int order = size(a) < size(b) ? -1 : size(b) < size(a) ? 1 : 0;
    return a.is_negative ? -order : order;
}

/// In millionths, so that steps are equal where they are.
std::int64_t number_of(const NamePart& part) {
    const std::string millionths = (part.fraction + "000000").substr(0, 6);
    const auto number = parse_number<std::int64_t>(part.digits + millionths).value_or(0);
    return part.is_negative ? -number : number;
}

/// From one name to the next, where they differ in one number.
std::optional<std::int64_t> step_between(const std::filesystem::path& a, const std::filesystem::path& b,
                                         const Reading& reading) {
    const std::vector<NamePart> one = parts_of(a, reading);
    const std::vector<NamePart> other = parts_of(b, reading);
    if (one.size() != other.size() || a.extension() != b.extension()) return std::nullopt;
    std::optional<std::int64_t> step;
    for (std::size_t i = 0; i < one.size(); ++i) {
        if (one[i].words != other[i].words || one[i].has_number != other[i].has_number) return std::nullopt;
        if (compared(one[i], other[i]) == 0) continue;
        if (step) return std::nullopt;
        step = number_of(other[i]) - number_of(one[i]);
    }
    return step;
}

bool comes_before(const std::vector<NamePart>& one, const std::vector<NamePart>& other) {
    for (std::size_t i = 0; i < std::min(one.size(), other.size()); ++i) {
        if (one[i].words != other[i].words) return one[i].words < other[i].words;
        if (one[i].has_number != other[i].has_number) return other[i].has_number;
        if (const int order = compared(one[i], other[i]); order != 0) return order < 0;
    }
    return one.size() < other.size();
}

}  // namespace

void sort_by_numbers(std::vector<std::filesystem::path>& files) {
    std::ranges::sort(files);
    const Reading reading = reading_of(files);
    std::map<std::filesystem::path, std::vector<NamePart>> parts;
    for (const auto& file : files) parts.emplace(file, parts_of(file, reading));
    std::ranges::stable_sort(
        files, comes_before, [&](const auto& file) -> const auto& { return parts.at(file); });
}

std::string doubt_of_order(const std::vector<std::filesystem::path>& files) {
    if (files.size() < 3) return {};
    const Reading reading = reading_of(files);
    std::vector<std::optional<std::int64_t>> steps;
    std::map<std::int64_t, std::size_t> times;
    std::size_t numbered = 0;
    for (std::size_t i = 1; i < files.size(); ++i) {
        steps.push_back(step_between(files[i - 1], files[i], reading));
        if (!steps.back()) continue;
        ++times[*steps.back()];
        ++numbered;
    }
    if (2 * numbered < steps.size()) return {};
    const auto usual = std::ranges::max_element(times, {}, [](const auto& one) { return one.second; });
    const auto odd = std::ranges::find_if(steps, [&](const auto& step) { return step != usual->first; });
    if (odd == steps.end()) return {};
    const auto before = static_cast<std::size_t>(odd - steps.begin());
    return fmt::format(
        "{}: the slice '{}' is followed by '{}', where most names differ by {:g}: is one missing, or one too "
        "many?",
        files.front().parent_path().string(), files[before].filename().string(),
        files[before + 1].filename().string(), static_cast<double>(usual->first) * 1e-6);
}

}  // namespace osteomill
