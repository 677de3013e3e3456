#include "imaging/formats/nifti_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

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
