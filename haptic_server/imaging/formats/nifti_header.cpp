#include "haptic_server/imaging/formats/nifti_header.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

#include "haptic_server/imaging/formats/plausible_geometry.h"
#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/formats/voxel_data.h"
#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::int32_t nifti1_header_bytes = 348;
constexpr std::int32_t nifti2_header_bytes = 540;
/// Extensions stand between header and voxels; notes about a patient, not another image.
constexpr double most_voxels_begin = 64.0 * 1024.0 * 1024.0;
constexpr std::size_t matrix_numbers = 12;

/// Values at offsets, in either byte order.
class NiftiFields {
  public:
    NiftiFields(std::span<const std::uint8_t> bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

    template <typename T>
    T at(std::size_t offset) const {
        std::array<std::uint8_t, sizeof(T)> raw{};
        std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), raw.begin());
        if (swapped_) std::reverse(raw.begin(), raw.end());
        T value{};
        std::memcpy(&value, raw.data(), sizeof(T));
        return value;
    }

  private:
    std::span<const std::uint8_t> bytes_;
    bool swapped_;
};

/// What both versions of the format say, each at its own offsets.
struct Stated {
    std::array<std::int64_t, 8> dim{};
    std::array<double, 4> pixdim{};
    double voxels_begin = 0.0;
    double slope = 0.0;
    double intercept = 0.0;
    int datatype = 0;
    int bits = 0;
    int qform = 0;
    int sform = 0;
    std::array<double, 6> quaternion_and_offset{};
    std::array<double, matrix_numbers> rows{};
    std::string magic;
};

template <typename Dim, typename Real>
void read_lists(const NiftiFields& fields, Stated& stated, std::size_t dim, std::size_t pixdim,
                std::size_t quaternion, std::size_t rows) {
    for (std::size_t i = 0; i < stated.dim.size(); ++i) stated.dim[i] = fields.at<Dim>(dim + sizeof(Dim) * i);
    for (std::size_t i = 0; i < stated.pixdim.size(); ++i)
        stated.pixdim[i] = static_cast<double>(fields.at<Real>(pixdim + sizeof(Real) * i));
    for (std::size_t i = 0; i < stated.quaternion_and_offset.size(); ++i)
        stated.quaternion_and_offset[i] = static_cast<double>(fields.at<Real>(quaternion + sizeof(Real) * i));
    for (std::size_t i = 0; i < stated.rows.size(); ++i)
        stated.rows[i] = static_cast<double>(fields.at<Real>(rows + sizeof(Real) * i));
}

Stated read_nifti1(const NiftiFields& fields) {
    Stated stated;
    read_lists<std::int16_t, float>(fields, stated, 40, 76, 256, 280);
    stated.voxels_begin = static_cast<double>(fields.at<float>(108));
    stated.slope = static_cast<double>(fields.at<float>(112));
    stated.intercept = static_cast<double>(fields.at<float>(116));
    stated.datatype = fields.at<std::int16_t>(70);
    stated.bits = fields.at<std::int16_t>(72);
    stated.qform = fields.at<std::int16_t>(252);
    stated.sform = fields.at<std::int16_t>(254);
    for (std::size_t i = 0; i < 3; ++i) stated.magic += fields.at<char>(344 + i);
    return stated;
}

Stated read_nifti2(const NiftiFields& fields) {
    Stated stated;
    read_lists<std::int64_t, double>(fields, stated, 16, 104, 352, 400);
    stated.voxels_begin = static_cast<double>(fields.at<std::int64_t>(168));
    stated.slope = fields.at<double>(176);
    stated.intercept = fields.at<double>(184);
    stated.datatype = fields.at<std::int16_t>(12);
    stated.bits = fields.at<std::int16_t>(14);
    stated.qform = fields.at<std::int32_t>(344);
    stated.sform = fields.at<std::int32_t>(348);
    for (std::size_t i = 0; i < 3; ++i) stated.magic += fields.at<char>(4 + i);
    return stated;
}

struct DataType {
    int number = 0;
    std::uint64_t bytes = 0;
    VoxelType type = VoxelType::uint8;
};
constexpr std::array data_types{DataType{2, 1, VoxelType::uint8},
                                DataType{256, 1, VoxelType::int8},
                                DataType{4, 2, VoxelType::int16},
                                DataType{512, 2, VoxelType::uint16},
                                DataType{8, 4, VoxelType::int32},
                                DataType{768, 4, VoxelType::uint32},
                                DataType{1024, 8, VoxelType::int64},
                                DataType{1280, 8, VoxelType::uint64},
                                DataType{16, 4, VoxelType::float32},
                                DataType{64, 8, VoxelType::float64},
                                DataType{128, 3},  // colour, which is refused later, by its name
                                DataType{2304, 4}};

void require_sizes(const Stated& stated, const std::filesystem::path& path, NiftiHeader& header) {
    if (stated.dim[0] < 1 || stated.dim[0] > 7)
        throw ImagingError(path, fmt::format("has {} dimensions (dim[0]); a volume has 3", stated.dim[0]));
    for (std::size_t axis = 1; axis <= static_cast<std::size_t>(stated.dim[0]); ++axis)
        header.sizes.push_back(static_cast<std::uint64_t>(std::max<std::int64_t>(stated.dim[axis], 0)));
    const auto known = std::find_if(data_types.begin(), data_types.end(), [&](const DataType& type) {
        return type.number == stated.datatype && static_cast<int>(8 * type.bytes) == stated.bits;
    });
    if (known == data_types.end())
        throw ImagingError(path, fmt::format("datatype {} of {} bits (datatype, bitpix) is not read",
                                             stated.datatype, stated.bits));
    try {
        header.voxels.type = known->type;
        header.voxel_bytes = plausible_voxel_count(header.sizes) * known->bytes;
    } catch (const std::invalid_argument& error) {
        throw ImagingError(path, error.what());
    }
}

void require_numbers(const Stated& stated, const std::filesystem::path& path, NiftiHeader& header) {
    for (std::size_t axis = 0; axis < 3 && axis < header.sizes.size(); ++axis) {
        header.spacing_mm[axis] = stated.pixdim[axis + 1];
        // A negative one is read as its amount.
        if (!is_plausible_spacing(std::abs(header.spacing_mm[axis])))
            throw ImagingError(path, implausible_spacing("spacing (pixdim)", header.spacing_mm[axis]));
    }
    if (!std::isfinite(stated.slope) || !std::isfinite(stated.intercept))
        throw ImagingError(path, fmt::format("scl_slope {} and scl_inter {} are not numbers", stated.slope,
                                             stated.intercept));
    // A slope of 0 stands for none.
    header.voxels.slope = stated.slope == 0.0 ? 1.0 : stated.slope;
    header.voxels.intercept = stated.intercept;
    const auto plausible = [](double number) { return std::abs(number) <= farthest_position_mm; };
    if (stated.qform > 0 &&
        !(std::all_of(stated.quaternion_and_offset.begin(), stated.quaternion_and_offset.end(), plausible) &&
          plausible(stated.pixdim[0])))
        throw ImagingError(path, implausible_position("its qform (quatern, qoffset)"));
    if (stated.sform > 0 && !std::all_of(stated.rows.begin(), stated.rows.end(), plausible))
        throw ImagingError(path, implausible_position("its sform (srow_x, srow_y, srow_z)"));
    for (std::size_t axis = 0; stated.sform > 0 && axis < 3; ++axis) {
        const double length_mm = std::hypot(stated.rows[axis], stated.rows[4 + axis], stated.rows[8 + axis]);
        if (!is_plausible_spacing(length_mm))
            throw ImagingError(path, implausible_spacing("spacing of its sform (srow)", length_mm));
    }
}

void require_beginning(const Stated& stated, const std::filesystem::path& path, double header_bytes,
                       NiftiHeader& header) {
    const double least = header.voxels_follow ? header_bytes : 0.0;
    if (!(stated.voxels_begin >= least && stated.voxels_begin <= most_voxels_begin))
        throw ImagingError(path, fmt::format("its voxels begin at byte {} (vox_offset); it must be {} to {}",
                                             stated.voxels_begin, least, most_voxels_begin));
    header.voxels_begin = static_cast<std::uint64_t>(stated.voxels_begin);
}

struct CloseGzip {
    void operator()(gzFile_s* file) const { gzclose(file); }
};

/// zlib reads plain files as they are.
std::vector<std::uint8_t> first_bytes_inflated(const std::filesystem::path& path) {
    { const RegularFile is_one(path); }
    const std::unique_ptr<gzFile_s, CloseGzip> file(gzopen(path.c_str(), "rb"));
    std::vector<std::uint8_t> bytes(most_nifti_header_bytes);
    const int read = file ? gzread(file.get(), bytes.data(), static_cast<unsigned>(bytes.size())) : -1;
    bytes.resize(static_cast<std::size_t>(std::max(read, 0)));
    return bytes;
}

bool is_gzip(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = RegularFile(path).first_bytes(2);
    return bytes == std::vector<std::uint8_t>{0x1f, 0x8b};
}

/// The .hdr or .img that belongs to the other; the NIfTI library takes the first of these.
std::filesystem::path other_of_pair(const std::filesystem::path& path, const char* suffix) {
    std::filesystem::path stem = path;
    if (stem.extension() == ".gz") stem.replace_extension();
    stem.replace_extension();
    std::filesystem::path found;
    for (const std::string& ending : {std::string(suffix), std::string(suffix) + ".gz"}) {
        const std::filesystem::path candidate = stem.string() + ending;
        if (!std::filesystem::exists(candidate)) continue;
        if (!found.empty())
            throw ImagingError(path, fmt::format("has both {} and {} beside it; which is meant?",
                                                 found.filename().string(), candidate.filename().string()));
        found = candidate;
    }
    if (found.empty())
        throw ImagingError(path,
                           fmt::format("its other half, {}{}, is missing", stem.filename().string(), suffix));
    return data_file_beside(path, found.filename().string());
}

bool is_half(const std::filesystem::path& path, const char* half) {
    std::string name = path.filename().string();
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name.ends_with(half) || name.ends_with(std::string(half) + ".gz");
}

}  // namespace

NiftiHeader parse_nifti_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
    const auto cut_off = [&] { return ImagingError(path, "cannot be read as NIfTI: cut off or damaged"); };
    if (bytes.size() < static_cast<std::size_t>(nifti1_header_bytes)) throw cut_off();
    for (const bool swapped : {false, true}) {
        const NiftiFields fields(bytes, swapped);
        const auto size = fields.at<std::int32_t>(0);
        const bool is_second = size == nifti2_header_bytes && bytes.size() >= most_nifti_header_bytes;
        if (size != nifti1_header_bytes && !is_second) continue;
        Stated stated = is_second ? read_nifti2(fields) : read_nifti1(fields);
        NiftiHeader header;
        header.voxels.big_endian = swapped != (std::endian::native == std::endian::big);
        header.voxels_follow = stated.magic.starts_with("n+");
        // Analyze 7.5 has other things where NIfTI has these.
        if (!header.voxels_follow && !stated.magic.starts_with("ni"))
            stated.qform = stated.sform = 0, stated.slope = stated.intercept = 0.0;
        require_sizes(stated, path, header);
        require_numbers(stated, path, header);
        require_beginning(stated, path, size, header);
        return header;
    }
    throw cut_off();
}

NiftiImage open_nifti(const std::filesystem::path& path) {
    const bool is_image_half = is_half(path, ".img");
    const std::filesystem::path header_file = is_image_half ? other_of_pair(path, ".hdr") : path;
    const NiftiHeader header = parse_nifti_header(first_bytes_inflated(header_file), header_file);
    std::filesystem::path voxel_file = path;
    if (is_half(path, ".hdr")) voxel_file = other_of_pair(path, ".img");
    if (voxel_file == header_file && !header.voxels_follow)
        throw ImagingError(path,
                           "is a header of NIfTI or Analyze whose voxels are in a file of their own, "
                           "but is not called .hdr");
    if (voxel_file != header_file && header.voxels_follow)
        throw ImagingError(header_file, "says that its voxels follow it; call it .nii");
    VoxelData data;
    VoxelPart part{.file = voxel_file, .begin = header.voxels_begin, .bytes = header.voxel_bytes};
    if (is_gzip(voxel_file)) {
        data.encoding = Encoding::gzip;
        part.begin = 0;
        part.skipped_bytes = header.voxels_begin;
    }
    data.parts.push_back(part);
    return {.header = header, .data = data};
}

}  // namespace osteomill
