#include "imaging/formats/image_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/files/input_file.h"
#include "common/text/words.h"
#include "imaging/dicom/dicom_image.h"
#include "imaging/dicom/dicom_precheck.h"
#include "imaging/formats/byte_source.h"
#include "imaging/formats/desktop_file.h"
#include "imaging/formats/meta_image_header.h"
#include "imaging/formats/nifti_header.h"
#include "imaging/formats/nrrd_header.h"
#include "imaging/formats/picture_stack.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// The facts by which an image is recognised: it is a folder, or a file with these first bytes, inflated if
/// they are gzip's.
struct ImageStart {
    std::filesystem::path path;
    ImageChoice choice;
    bool is_folder = false;
    std::vector<std::uint8_t> bytes{};
    bool is_gzip = false;

    bool starts_with(std::string_view mark) const {
        return bytes.size() >= mark.size() &&
               std::equal(mark.begin(), mark.end(), bytes.begin(),
                          [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    }
};

ImageStart start_of(const std::filesystem::path& path, const ImageChoice& choice) {
    constexpr std::size_t start_bytes = 4096;
    std::error_code failed;
    const std::filesystem::file_status status = std::filesystem::status(path, failed);
    if (!std::filesystem::exists(status)) throw ImagingError(path, "does not exist");
    ImageStart start{.path = path, .choice = choice, .is_folder = std::filesystem::is_directory(status)};
    if (start.is_folder) return start;
    if (!std::filesystem::is_regular_file(status)) throw ImagingError(path, "is neither a file nor a folder");
    const InputFile file(path);
    start.bytes = file.first_bytes(2);
    start.is_gzip = start.starts_with("\x1f\x8b");
    start.bytes = first_bytes_inflated(file, start_bytes);
    if (start.bytes.empty())
        throw ImagingError(
            path, start.is_gzip ? "is cut off: its gzip holds nothing that can be read" : "is empty");
    return start;
}

/// The text header begins with fields, of which "NDims" is one of the first. It has no mark, so a file with
/// its ending that is no other format counts as one, and its reader reports the fault.
bool is_meta_image(const ImageStart& start) {
    const std::string ending = lower_case(start.path.extension().string());
    if (ending == ".mha" || ending == ".mhd") return true;
    const std::string_view text(reinterpret_cast<const char*>(start.bytes.data()), start.bytes.size());
    return start.starts_with("ObjectType") || start.starts_with("NDims") ||
           text.substr(0, text.find('\0')).find("\nNDims") != std::string_view::npos;
}

bool has_dicom_mark(const ImageStart& start) {
    const std::string_view text(reinterpret_cast<const char*>(start.bytes.data()), start.bytes.size());
    return text.size() >= 132 && text.substr(128, 4) == "DICM";
}

bool is_stack(const ImageStart& start) {
    using namespace std::string_view_literals;
    if (start.is_folder) return is_picture_folder(start.path, start.choice.stack_spacing_mm.has_value());
    constexpr std::array marks{"\x89PNG"sv, "II*\0"sv, "MM\0*"sv, "II+\0"sv, "MM\0+"sv};  // + of large TIFF
    return std::ranges::any_of(marks, [&](std::string_view mark) { return start.starts_with(mark); });
}

/// Headers and files are held against each other before anything is read.
/// Labels may be of a single slice: programs crop them.
OpenedImage opened(const std::filesystem::path& path, ImageHeader header, ImagePurpose purpose) {
    VoxelData data = find_voxels(header, path);
    if (const std::uint64_t more = require_room(data); more > 0)
        header.image.notes.push_back(
            fmt::format("{}: {} bytes follow its voxels; they are not read", path.string(), more));
    const glm::ivec3 size = header.image.size_voxels;
    if (purpose == ImagePurpose::scan && std::min({size.x, size.y, size.z}) < 2)
        throw ImagingError(path, fmt::format("is a single slice ({} x {} x {} voxels), which is no volume",
                                             size.x, size.y, size.z));
    const glm::ivec3 size_of_values = size * glm::ivec3(header.layers, 1, 1);
    std::vector<std::filesystem::path> data_files;
    for (const VoxelPart& part : data.parts)
        if (part.file != path) data_files.push_back(part.file);
    return {.image = std::move(header.image),
            .layers = header.layers,
            .key_values = std::move(header.key_values),
            .data_files = std::move(data_files),
            .read_slices =
                [data = std::move(data), voxels = header.voxels, size_of_values](
                    const TakeSlice& take, const ReportProgress& report) {
                    read_value_slices(data, voxels, size_of_values, take, report);
                },
            .reading_bytes = sizeof(float) * static_cast<std::uint64_t>(size_of_values.x) *
                             static_cast<std::uint64_t>(size_of_values.y)};
}

struct ImageFormat {
    const char* name;
    std::array<std::string_view, 2> endings;  ///< its files' endings; empty: no rule
    bool (*is)(const ImageStart&);
    OpenedImage (*open)(const ImageStart&, ImagePurpose);
};
/// To read another format is a file and a row. The first that fits is taken.
constexpr std::array image_formats{
    ImageFormat{"NRRD",
                {".nrrd", ".nhdr"},
                [](const ImageStart& start) { return start.starts_with("NRRD") && !start.is_gzip; },
                [](const ImageStart& start, ImagePurpose purpose) {
                    return opened(start.path, open_nrrd(start.path), purpose);
                }},
    ImageFormat{"NIfTI",
                {".nii", ".nii.gz"},
                [](const ImageStart& start) {
                    // Others call their files .img, too.
                    const bool is_another = is_meta_image(start) || has_dicom_mark(start);
                    return begins_as_nifti(start.bytes) ||
                           (!start.is_folder && !is_another && is_nifti_voxel_file(start.path));
                },
                [](const ImageStart& start, ImagePurpose purpose) {
                    return opened(start.path, open_nifti(start.path), purpose);
                }},
    ImageFormat{"folder of PNG or TIFF pictures",
                {},
                is_stack,
                [](const ImageStart& start, ImagePurpose purpose) {
                    return open_picture_stack(start.path, start.choice.stack_spacing_mm, purpose);
                }},
    ImageFormat{"DICOM folder or file",
                {},
                [](const ImageStart& start) {
                    return start.is_folder || (may_be_dicom(start.bytes) && !start.is_gzip);
                },
                [](const ImageStart& start, ImagePurpose purpose) {
                    return start.is_folder ? open_dicom_folder(start.path, start.choice.series_uid, purpose)
                                           : open_dicom_file(start.path, purpose);
                }},
    ImageFormat{"MetaImage",
                {".mha", ".mhd"},
                [](const ImageStart& start) { return is_meta_image(start) && !start.is_gzip; },
                [](const ImageStart& start, ImagePurpose purpose) {
                    return opened(start.path, open_meta_image(start.path), purpose);
                }}};

OpenedImage open_any(const std::filesystem::path& path, const ImageChoice& choice, ImagePurpose purpose) {
    const ImageStart start = start_of(path, choice);
    const auto format =
        std::ranges::find_if(image_formats, [&](const ImageFormat& one) { return one.is(start); });
    if (format != image_formats.end()) return format->open(start, purpose);
    std::vector<std::string> names;
    for (const ImageFormat& one : image_formats)
        names.push_back(one.endings.front().empty()
                            ? one.name
                            : fmt::format("{} ({})", one.name, fmt::join(one.endings, ", ")));
    const std::string last = std::move(names.back());
    names.pop_back();
    throw ImagingError(path, fmt::format("is no {} or {}{}", fmt::join(names, ", "), last,
                                         start.is_gzip ? "; it is gzip of something else: unpack it first"
                                                       : ": it begins as none of them"));
}

}  // namespace

bool is_image_name(const std::filesystem::path& path) {
    const std::string name = lower_case(path.filename().string());
    if (is_of_the_desktop(path)) return false;
    return std::ranges::any_of(image_formats, [&](const ImageFormat& one) {
        return std::ranges::any_of(
            one.endings, [&](std::string_view ending) { return !ending.empty() && name.ends_with(ending); });
    });
}

std::string name_without_ending(const std::filesystem::path& path) {
    std::string name = path.filename().string();
    const auto take_off = [&](std::string_view ending) {
        if (!ending.empty() && lower_case(name).ends_with(ending)) name.resize(name.size() - ending.size());
    };
    for (const std::string_view ending : {".gz", ".dcm", ".hdr", ".img", ".tif", ".tiff"}) take_off(ending);
    for (const ImageFormat& one : image_formats) std::ranges::for_each(one.endings, take_off);
    take_off(".seg");
    return name;
}

std::vector<std::filesystem::path> files_of_image(const std::filesystem::path& path) {
    std::vector<std::filesystem::path> files{path};
    std::error_code failed;
    if (std::filesystem::is_directory(path, failed)) return files;
    try {
        if (is_nifti_voxel_file(path)) files.push_back(nifti_header_file(path));
        const OpenedImage image = open_labels(path);
        files.insert(files.end(), image.data_files.begin(), image.data_files.end());
    } catch (const std::runtime_error&) {
        // The caller says so.
    }
    return files;
}

OpenedImage open_labels(const std::filesystem::path& path, const ImageChoice& choice) {
    return open_any(path, choice, ImagePurpose::labels);
}

OpenedImage open_image(const std::filesystem::path& path, const ImageChoice& choice) {
    OpenedImage image = open_any(path, choice, ImagePurpose::scan);
    if (image.is_coloured)
        throw ImagingError(
            path,
            "holds coloured pictures, which have no CT numbers; where colours are tissues, give "
            "--labels in place of INPUT");
    if (image.layers > 1)
        throw ImagingError(
            path, fmt::format("has {} values a voxel (colour, vectors or layers); CT has one", image.layers));
    return image;
}

namespace {

/// Fills slices and hands them on; data after the last one are skipped.
class SliceFiller {
  public:
    SliceFiller(const VoxelLayout& layout, const glm::ivec3& size_voxels, const TakeSlice& take,
                const ReportProgress& report)
        : slope_(layout.slope),
          intercept_(layout.intercept),
          slices_(size_voxels.z),
          take_(take),
          report_(report),
          slice_(static_cast<std::size_t>(size_voxels.x) * static_cast<std::size_t>(size_voxels.y)) {}

    template <typename Voxel>
    void add(Voxel voxel) {
        if (is_full()) return;
        slice_[values_++] = static_cast<float>(slope_ * static_cast<double>(voxel) + intercept_);
        if (values_ < slice_.size()) return;
        values_ = 0;
        take_(k_++, slice_);
        report_(static_cast<double>(k_) / slices_);
    }
    bool is_full() const { return k_ == slices_; }

  private:
    double slope_;
    double intercept_;
    int slices_;
    const TakeSlice& take_;
    const ReportProgress& report_;
    std::vector<float> slice_;
    std::size_t values_ = 0;
    int k_ = 0;
};

/// Turns bytes into values as they come; a voxel may lie across two pieces.
template <typename Voxel>
class BinaryConverter {
  public:
    BinaryConverter(bool big_endian, SliceFiller& slices)
        : swapped_(big_endian != (std::endian::native == std::endian::big)), slices_(slices) {}

    void take(std::span<const std::byte> bytes) {
        while (filled_ > 0 && !bytes.empty()) {
            broken_[filled_++] = bytes.front();
            bytes = bytes.subspan(1);
            if (filled_ < sizeof(Voxel)) continue;
            add(broken_.data());
            filled_ = 0;
        }
        for (; bytes.size() >= sizeof(Voxel); bytes = bytes.subspan(sizeof(Voxel))) add(bytes.data());
        for (const std::byte byte : bytes) broken_[filled_++] = byte;
    }

  private:
    void add(const std::byte* bytes) {
        std::array<std::byte, sizeof(Voxel)> ordered;
        std::copy_n(bytes, sizeof(Voxel), ordered.begin());
        if (swapped_) std::reverse(ordered.begin(), ordered.end());
        Voxel voxel{};
        std::memcpy(&voxel, ordered.data(), sizeof voxel);
        slices_.add(voxel);
    }

    bool swapped_;
    SliceFiller& slices_;
    std::array<std::byte, sizeof(Voxel)> broken_{};
    std::size_t filled_ = 0;
};

/// Numbers in decimal, with blanks or commas between.
class TextConverter {
  public:
    TextConverter(const std::filesystem::path& path, SliceFiller& slices) : path_(path), slices_(slices) {}

    void take(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) {
            const auto letter = static_cast<char>(byte);
            if (letter == ',' || letter == ' ' || (letter >= '\t' && letter <= '\r')) {
                end_word();
            } else if (!slices_.is_full()) {
                word_ += letter;
                if (word_.size() > longest_word) refuse();
            }
        }
    }

  private:
    static constexpr std::size_t longest_word = 64;

    void end_word() {
        if (word_.empty()) return;
        const std::string_view digits = std::string_view(word_).substr(word_.front() == '+' ? 1 : 0);
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size()) refuse();
        slices_.add(value);
        word_.clear();
    }
    [[noreturn]] void refuse() const {
        throw ImagingError(path_, fmt::format("its voxels are damaged: '{}' is no number", word_));
    }

    const std::filesystem::path& path_;
    SliceFiller& slices_;
    std::string word_;
};

template <typename Voxel>
void read_binary(const VoxelData& data, const VoxelLayout& layout, SliceFiller& slices) {
    BinaryConverter<Voxel> converter(layout.big_endian, slices);
    read_voxel_data(data, [&](std::span<const std::byte> bytes) { converter.take(bytes); });
}

void read_text(const VoxelData& data, SliceFiller& slices) {
    TextConverter converter(data.parts.front().file, slices);
    read_voxel_data(data, [&](std::span<const std::byte> bytes) { converter.take(bytes); });
    if (!slices.is_full())
        throw ImagingError(data.parts.front().file, "is cut off: it holds fewer numbers than voxels");
}

}  // namespace

void read_value_slices(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                       const TakeSlice& take, const ReportProgress& report) {
    SliceFiller slices(layout, size_voxels, take, report);
    if (data.encoding == Encoding::text) return read_text(data, slices);
    // By VoxelType.
    constexpr std::array readers{read_binary<std::int8_t>,  read_binary<std::uint8_t>,
                                 read_binary<std::int16_t>, read_binary<std::uint16_t>,
                                 read_binary<std::int32_t>, read_binary<std::uint32_t>,
                                 read_binary<std::int64_t>, read_binary<std::uint64_t>,
                                 read_binary<float>,        read_binary<double>};
    readers[static_cast<std::size_t>(layout.type)](data, layout, slices);
}

}  // namespace osteomill
