#include "imaging/formats/nifti_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <string>

#include "common/files/input_file.h"
#include "common/text/words.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/formats/voxel_data.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// Extensions stand between header and voxels; notes about a patient, not another image.
constexpr double most_voxels_begin = 64.0 * 1024.0 * 1024.0;

struct DataType {
    int number = 0;
    std::uint64_t bytes = 0;
    VoxelType type = VoxelType::uint8;
};
constexpr std::array data_types{DataType{2, 1, VoxelType::uint8},    DataType{256, 1, VoxelType::int8},
                                DataType{4, 2, VoxelType::int16},    DataType{512, 2, VoxelType::uint16},
                                DataType{8, 4, VoxelType::int32},    DataType{768, 4, VoxelType::uint32},
                                DataType{1024, 8, VoxelType::int64}, DataType{1280, 8, VoxelType::uint64},
                                DataType{16, 4, VoxelType::float32}, DataType{64, 8, VoxelType::float64}};

void read_sizes(const NiftiStatements& stated, const std::filesystem::path& path, NiftiHeader& header) {
    if (stated.dim[0] < 1 || stated.dim[0] > 7)
        throw ImagingError(path, fmt::format("has {} dimensions (dim[0]); a volume has 3", stated.dim[0]));
    std::vector<std::uint64_t> sizes;
    for (std::size_t axis = 1; axis <= static_cast<std::size_t>(stated.dim[0]); ++axis)
        sizes.push_back(static_cast<std::uint64_t>(std::max<std::int64_t>(stated.dim[axis], 0)));
    // Beyond space some write 0 for 1.
    while (sizes.size() > 3 && sizes.back() <= 1) sizes.pop_back();
    if (stated.datatype == 128 || stated.datatype == 2304)
        throw ImagingError(path, "has several values a voxel (colour, datatype RGB); CT has one");
    const auto known = std::find_if(data_types.begin(), data_types.end(), [&](const DataType& type) {
        return type.number == stated.datatype && static_cast<int>(8 * type.bytes) == stated.bits;
    });
    if (known == data_types.end())
        throw ImagingError(path, fmt::format("datatype {} of {} bits (datatype, bitpix) is not read",
                                             stated.datatype, stated.bits));
    header.voxels.type = known->type;
    header.voxel_bytes = said_of(path, [&] { return plausible_voxel_count(sizes) * known->bytes; });
    if (sizes.size() != 3)
        throw ImagingError(path, fmt::format("has {} dimensions; a volume has 3", sizes.size()));
    for (int axis = 0; axis < 3; ++axis)
        header.image.size_voxels[axis] = static_cast<int>(sizes[static_cast<std::size_t>(axis)]);
}

void read_rescale(const NiftiStatements& stated, const std::filesystem::path& path, NiftiHeader& header) {
    // A slope of 0 means no rescale. So does NaN, which nibabel writes.
    if (stated.slope == 0.0 || std::isnan(stated.slope)) return;
    if (!std::isfinite(stated.slope) || !std::isfinite(stated.intercept))
        throw ImagingError(path, fmt::format("scl_slope {} and scl_inter {} are not numbers", stated.slope,
                                             stated.intercept));
    header.voxels.slope = stated.slope;
    header.voxels.intercept = stated.intercept;
}

void require_beginning(const NiftiStatements& stated, const std::filesystem::path& path, double header_bytes,
                       NiftiHeader& header) {
    const double least = header.voxels_follow ? header_bytes : 0.0;
    if (!(stated.voxels_begin >= least && stated.voxels_begin <= most_voxels_begin))
        throw ImagingError(path, fmt::format("its voxels begin at byte {} (vox_offset); it must be {} to {}",
                                             stated.voxels_begin, least, most_voxels_begin));
    header.byte_skip = static_cast<std::int64_t>(stated.voxels_begin);
}

bool is_gzip(const std::filesystem::path& path) {
    const std::vector<std::uint8_t> bytes = InputFile(path).first_bytes(2);
    return bytes == std::vector<std::uint8_t>{0x1f, 0x8b};
}

/// The .hdr or .img that belongs to the other; the NIfTI library takes the first of these.
std::filesystem::path other_of_pair(const std::filesystem::path& path, const char* suffix) {
    std::filesystem::path stem = path;
    if (stem.extension() == ".gz") stem.replace_extension();
    stem.replace_extension();
    std::filesystem::path found;
    std::string upper = suffix;
    std::ranges::transform(upper, upper.begin(), [](unsigned char letter) { return std::toupper(letter); });
    for (const std::string& ending :
         {std::string(suffix), std::string(suffix) + ".gz", upper, upper + ".GZ"}) {
        const std::filesystem::path candidate = stem.string() + ending;
        if (!std::filesystem::exists(candidate)) continue;
        // A disk may take capitals for small letters.
        if (!found.empty() && std::filesystem::equivalent(found, candidate)) continue;
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
    const std::string name = lower_case(path.filename().string());
    return name.ends_with(half) || name.ends_with(std::string(half) + ".gz");
}

}  // namespace

bool begins_as_nifti(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < sizeof(std::int32_t)) return false;
    for (const bool swapped : {false, true}) {
        const auto size = NiftiFields(bytes, swapped).at<std::int32_t>(0);
        if (size == nifti1_header_bytes || size == nifti2_header_bytes) return true;
    }
    return false;
}

bool is_nifti_voxel_file(const std::filesystem::path& path) {
    return is_half(path, ".img");
}

NiftiHeader parse_nifti_header(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
    if (!begins_as_nifti(bytes))
        throw ImagingError(path, "is no NIfTI: its first number must be 348 or 540, the size of its header");
    const bool swapped = NiftiFields(bytes, false).at<std::int32_t>(0) != nifti1_header_bytes &&
                         NiftiFields(bytes, false).at<std::int32_t>(0) != nifti2_header_bytes;
    const NiftiFields fields(bytes, swapped);
    const auto size = fields.at<std::int32_t>(0);
    if (bytes.size() < static_cast<std::size_t>(size))
        throw ImagingError(path, fmt::format("is cut off: {} of the {} bytes of a NIfTI header are there",
                                             bytes.size(), size));
    NiftiStatements stated = size == nifti2_header_bytes ? read_nifti2(fields) : read_nifti1(fields);
    NiftiHeader header;
    header.voxels.big_endian = swapped != (std::endian::native == std::endian::big);
    header.voxels_follow = stated.magic.starts_with("n+");
    // Analyze 7.5 has other things where NIfTI has these.
    if (!header.voxels_follow && !stated.magic.starts_with("ni")) {
        stated.qform = stated.sform = stated.units = 0;
        if (std::isfinite(stated.slope) && stated.slope != 0.0 && stated.slope != 1.0)
            header.image.notes.push_back(fmt::format(
                "{}: is of Analyze, where SPM writes a scale: {} stands there and is not applied; --rescale "
                "applies one",
                path.string(), stated.slope));
        stated.slope = stated.intercept = 0.0;
    }
    read_sizes(stated, path, header);
    read_rescale(stated, path, header);
    require_beginning(stated, path, size, header);
    read_nifti_geometry(stated, path, header.image);
    return header;
}

std::filesystem::path nifti_header_file(const std::filesystem::path& path) {
    return is_half(path, ".img") ? other_of_pair(path, ".hdr") : path;
}

ImageHeader open_nifti(const std::filesystem::path& path) {
    const std::filesystem::path header_file = nifti_header_file(path);
    NiftiHeader header = parse_nifti_header(
        first_bytes_inflated(InputFile(header_file), most_nifti_header_bytes), header_file);
    std::filesystem::path voxel_file = path;
    if (is_half(path, ".hdr")) voxel_file = other_of_pair(path, ".img");
    if (voxel_file == header_file && !header.voxels_follow)
        throw ImagingError(path,
                           "is a header of NIfTI or Analyze whose voxels are in a file of their own, "
                           "but is not called .hdr");
    if (voxel_file != header_file && header.voxels_follow)
        throw ImagingError(header_file, "says that its voxels follow it; call it .nii");
    if (voxel_file != path) header.data_files = {voxel_file.filename().string()};
    if (is_gzip(voxel_file)) header.encoding = Encoding::gzip;
    return header;
}

namespace {

/// Spacings, directions and positions (of a voxel) that differ by less are equal.
constexpr double same_within = 1e-3;

/// An orientation that the header states: steps of the axes, patient RAS, in the header's unit.
struct NiftiForm {
    std::array<glm::dvec3, 3> step{};
    glm::dvec3 origin{0.0};
};

double shear_of_steps(const NiftiForm& form) {
    SourceImage image;
    for (int axis = 0; axis < 3; ++axis)
        image.direction[axis] = glm::normalize(form.step[static_cast<std::size_t>(axis)]);
    return shear_of(image);
}

NiftiForm form_of_sform(const NiftiStatements& stated) {
    NiftiForm form;
    for (std::size_t row = 0; row < 3; ++row) {
        const int i = static_cast<int>(row);
        for (std::size_t axis = 0; axis < 3; ++axis) form.step[axis][i] = stated.rows[4 * row + axis];
        form.origin[i] = stated.rows[4 * row + 3];
    }
    return form;
}

/// Without a qform: axes along right, anterior, superior.
NiftiForm form_of_qform(const NiftiStatements& stated) {
    const auto& [b, c, d, x, y, z] = stated.quaternion_and_offset;
    const bool is_stated = stated.qform > 0;
    const double length = is_stated ? std::max(std::sqrt(b * b + c * c + d * d), 1.0) : 1.0;
    const glm::dvec3 q = is_stated ? glm::dvec3(b, c, d) / length : glm::dvec3(0.0);
    const double a = std::sqrt(std::max(0.0, 1.0 - glm::dot(q, q)));
    glm::dmat3 rotation;  // columns, as nifti1.h has it
    rotation[0] = {a * a + q.x * q.x - q.y * q.y - q.z * q.z, 2 * (q.x * q.y + a * q.z),
                   2 * (q.x * q.z - a * q.y)};
    rotation[1] = {2 * (q.x * q.y - a * q.z), a * a + q.y * q.y - q.x * q.x - q.z * q.z,
                   2 * (q.y * q.z + a * q.x)};
    rotation[2] = {2 * (q.x * q.z + a * q.y), 2 * (q.y * q.z - a * q.x),
                   a * a + q.z * q.z - q.x * q.x - q.y * q.y};
    if (is_stated && stated.pixdim[0] < 0.0) rotation[2] = -rotation[2];
    NiftiForm form;
    for (std::size_t axis = 0; axis < 3; ++axis)
        form.step[axis] = std::abs(stated.pixdim[axis + 1]) * rotation[static_cast<int>(axis)];
    if (is_stated) form.origin = {x, y, z};
    return form;
}

/// A message on the statements that contradict the sform; empty if none does.
std::string contradiction(const NiftiForm& sform, const NiftiStatements& stated) {
    std::array<double, 3> length{};
    for (std::size_t axis = 0; axis < 3; ++axis) length[axis] = glm::length(sform.step[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(std::abs(std::abs(stated.pixdim[axis + 1]) - length[axis]) <= same_within * length[axis]))
            return fmt::format(
                "its sform says voxels of {:.6g} x {:.6g} x {:.6g}, its pixdim {:.6g} x {:.6g} x {:.6g}",
                length[0], length[1], length[2], stated.pixdim[1], stated.pixdim[2], stated.pixdim[3]);
    if (stated.qform <= 0) return {};
    const NiftiForm qform = form_of_qform(stated);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!(glm::distance(qform.step[axis], sform.step[axis]) <= 10.0 * same_within * length[axis]))
            return fmt::format("its sform and its qform turn axis {} differently", "ijk"[axis]);
    if (!(glm::distance(qform.origin, sform.origin) <= *std::min_element(length.begin(), length.end())))
        return fmt::format("its sform and its qform place it {:.6g} apart",
                           glm::distance(qform.origin, sform.origin));
    return {};
}

double mm_of_nifti_unit(int units, const std::filesystem::path& path) {
    switch (units & 7) {
        case 0:  // not stated
        case 2:
            return 1.0;
        case 1:
            return 1000.0;
        case 3:
            return 1e-3;
        default:
            throw ImagingError(
                path, fmt::format("xyzt_units {}: m (1), mm (2) and micrometres (3) are read", units & 7));
    }
}

void require_numbers(const NiftiStatements& stated, double mm, const std::filesystem::path& path) {
    const auto plausible = [&](double number) { return std::abs(number * mm) <= farthest_position_mm; };
    if (stated.qform > 0 &&
        !(std::all_of(stated.quaternion_and_offset.begin(), stated.quaternion_and_offset.end(), plausible) &&
          plausible(stated.pixdim[0])))
        throw ImagingError(path, implausible_position("its qform (quatern, qoffset)"));
    if (stated.sform > 0 && !std::all_of(stated.rows.begin(), stated.rows.end(), plausible))
        throw ImagingError(path, implausible_position("its sform (srow_x, srow_y, srow_z)"));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double spacing_mm = std::abs(stated.pixdim[axis + 1]) * mm;
        const double length_mm =
            std::hypot(stated.rows[axis], stated.rows[4 + axis], stated.rows[8 + axis]) * mm;
        if (stated.sform > 0 && !is_plausible_spacing(length_mm))
            throw ImagingError(path, implausible_spacing("spacing of its sform (srow)", length_mm));
        if (stated.sform <= 0 && !is_plausible_spacing(spacing_mm))
            throw ImagingError(path, implausible_spacing("spacing (pixdim)", spacing_mm));
    }
}

template <typename Dim, typename Real>
void read_lists(const NiftiFields& fields, NiftiStatements& stated, std::size_t dim, std::size_t pixdim,
                std::size_t quaternion, std::size_t rows) {
    for (std::size_t i = 0; i < stated.dim.size(); ++i) stated.dim[i] = fields.at<Dim>(dim + sizeof(Dim) * i);
    for (std::size_t i = 0; i < stated.pixdim.size(); ++i)
        stated.pixdim[i] = static_cast<double>(fields.at<Real>(pixdim + sizeof(Real) * i));
    for (std::size_t i = 0; i < stated.quaternion_and_offset.size(); ++i)
        stated.quaternion_and_offset[i] = static_cast<double>(fields.at<Real>(quaternion + sizeof(Real) * i));
    for (std::size_t i = 0; i < stated.rows.size(); ++i)
        stated.rows[i] = static_cast<double>(fields.at<Real>(rows + sizeof(Real) * i));
}

}  // namespace

void read_nifti_geometry(const NiftiStatements& stated, const std::filesystem::path& path,
                         SourceImage& image) {
    const double mm = mm_of_nifti_unit(stated.units, path);
    require_numbers(stated, mm, path);
    const NiftiForm form = stated.sform > 0 ? form_of_sform(stated) : form_of_qform(stated);
    constexpr glm::dvec3 ras_to_lps(-1.0, -1.0, 1.0);
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3& step = form.step[static_cast<std::size_t>(axis)];
        image.spacing_mm[axis] = glm::length(step) * mm;
        image.direction[axis] = ras_to_lps * step / glm::length(step);
    }
    image.origin_mm = ras_to_lps * form.origin * mm;
    if (mm != 1.0)
        image.notes.push_back(fmt::format("{}: its units (xyzt_units) are {}; converted to mm", path.string(),
                                          mm > 1.0 ? "m" : "um"));
    if (stated.sform > 0) {
        if (const std::string both = contradiction(form, stated); !both.empty()) {
            if (shear_of_steps(form) > same_within)
                throw ImagingError(
                    path, fmt::format("{}, and {} in the sform, which is no rotation times spacings; "
                                      "which is meant?",
                                      both, sheared_axes(image)));
            image.notes.push_back(fmt::format("{}: warning: {}; the sform is followed", path.string(), both));
        }
    } else if (stated.qform <= 0) {
        note_guessed_orientation(image, path, "it has neither a qform nor a sform",
                                 "right-anterior-superior (RAS)");
    }
    settle_geometry(image, path);
}

NiftiStatements read_nifti1(const NiftiFields& fields) {
    NiftiStatements stated;
    read_lists<std::int16_t, float>(fields, stated, 40, 76, 256, 280);
    stated.voxels_begin = static_cast<double>(fields.at<float>(108));
    stated.slope = static_cast<double>(fields.at<float>(112));
    stated.intercept = static_cast<double>(fields.at<float>(116));
    stated.datatype = fields.at<std::int16_t>(70);
    stated.bits = fields.at<std::int16_t>(72);
    stated.qform = fields.at<std::int16_t>(252);
    stated.sform = fields.at<std::int16_t>(254);
    stated.units = fields.at<std::uint8_t>(123);
    for (std::size_t i = 0; i < 3; ++i) stated.magic += fields.at<char>(344 + i);
    return stated;
}

NiftiStatements read_nifti2(const NiftiFields& fields) {
    NiftiStatements stated;
    read_lists<std::int64_t, double>(fields, stated, 16, 104, 352, 400);
    stated.voxels_begin = static_cast<double>(fields.at<std::int64_t>(168));
    stated.slope = fields.at<double>(176);
    stated.intercept = fields.at<double>(184);
    stated.datatype = fields.at<std::int16_t>(12);
    stated.bits = fields.at<std::int16_t>(14);
    stated.qform = fields.at<std::int32_t>(344);
    stated.sform = fields.at<std::int32_t>(348);
    stated.units = fields.at<std::int32_t>(500);
    for (std::size_t i = 0; i < 3; ++i) stated.magic += fields.at<char>(4 + i);
    return stated;
}

}  // namespace osteomill
