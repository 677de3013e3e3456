#include "haptic_server/imaging/nifti_header.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::int32_t nifti1_header_bytes = 348;
constexpr std::int32_t nifti2_header_bytes = 540;

struct CloseGzip {
    void operator()(gzFile_s* file) const { gzclose(file); }
};
using GzipFile = std::unique_ptr<gzFile_s, CloseGzip>;

/// A value at an offset, from either byte order.
template <typename T>
T value_at(const std::vector<unsigned char>& bytes, std::size_t offset, bool swapped) {
    std::array<unsigned char, sizeof(T)> raw{};
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
    if (swapped) std::reverse(raw.begin(), raw.end());
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
}

struct NiftiHeader {
    std::array<double, 3> spacing_mm{};
    std::uint64_t voxels_begin = 0;
};

/// zlib reads plain files as they are.
NiftiHeader read_nifti_header(const std::filesystem::path& path) {
    const GzipFile file(gzopen(path.c_str(), "rb"));
    std::vector<unsigned char> bytes(nifti2_header_bytes);
    const int read = file ? gzread(file.get(), bytes.data(), static_cast<unsigned>(bytes.size())) : -1;
    const auto cut_off = [&] { return ImagingError(path, "cannot be read as NIfTI: cut off or damaged"); };
    if (read < nifti1_header_bytes) throw cut_off();
    for (const bool swapped : {false, true}) {
        const auto size = value_at<std::int32_t>(bytes, 0, swapped);
        NiftiHeader header;
        if (size == nifti1_header_bytes) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                header.spacing_mm[axis] = value_at<float>(bytes, 80 + 4 * axis, swapped);
            header.voxels_begin =
                static_cast<std::uint64_t>(std::clamp(value_at<float>(bytes, 108, swapped), 0.0F, 1e9F));
            return header;
        }
        if (size == nifti2_header_bytes && read == nifti2_header_bytes) {
            for (std::size_t axis = 0; axis < 3; ++axis)
                header.spacing_mm[axis] = value_at<double>(bytes, 112 + 8 * axis, swapped);
            header.voxels_begin = static_cast<std::uint64_t>(
                std::max<std::int64_t>(value_at<std::int64_t>(bytes, 168, swapped), 0));
            return header;
        }
    }
    throw cut_off();
}

/// Bytes of a file when inflated; std::nullopt where its gzip stream breaks off.
std::optional<std::uint64_t> inflated_bytes(const std::filesystem::path& path) {
    const GzipFile file(gzopen(path.c_str(), "rb"));
    if (!file) return std::nullopt;
    std::vector<unsigned char> buffer(1u << 20);
    std::uint64_t total = 0;
    int read = 0;
    while ((read = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()))) > 0)
        total += static_cast<std::uint64_t>(read);
    int error = Z_OK;
    gzerror(file.get(), &error);
    if (read < 0 || error == Z_BUF_ERROR || error == Z_DATA_ERROR) return std::nullopt;
    return total;
}

bool holds_its_voxels(const std::filesystem::path& path) {
    return path.string().find(".nii") != std::string::npos;
}

}  // namespace

void require_nifti_spacing(const std::filesystem::path& path) {
    if (!holds_its_voxels(path)) return;
    const NiftiHeader header = read_nifti_header(path);
    for (const double spacing_mm : header.spacing_mm)
        if (!(std::abs(spacing_mm) > 0.0) || !std::isfinite(spacing_mm))
            throw ImagingError(
                path, fmt::format("spacing (pixdim) {} x {} x {} mm: every axis needs a number above 0",
                                  header.spacing_mm[0], header.spacing_mm[1], header.spacing_mm[2]));
}

void require_whole_nifti(const std::filesystem::path& path, std::uint64_t voxel_bytes) {
    if (!holds_its_voxels(path)) return;
    const std::uint64_t expected = read_nifti_header(path).voxels_begin + voxel_bytes;
    const std::optional<std::uint64_t> found = inflated_bytes(path);
    if (!found) throw ImagingError(path, "is cut off or damaged: its gzip stream breaks off");
    if (*found < expected)
        throw ImagingError(path, fmt::format("is cut off: {} of {} bytes are there", *found, expected));
}

}  // namespace osteomill
