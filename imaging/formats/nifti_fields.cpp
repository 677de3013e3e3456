#include "imaging/formats/nifti_fields.h"

namespace osteomill {

namespace {

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
