#include "slicer/igtl_messages.h"

#include <openigtlink/igtlImageMessage.h>
#include <openigtlink/igtlStatusMessage.h>
#include <openigtlink/igtlStringMessage.h>
#include <openigtlink/igtlTransformMessage.h>

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>
#include <stdexcept>

namespace osteomill {

namespace {

constexpr std::size_t longest_name = 20;
constexpr std::size_t longest_text = 65'535;

/// A matrix whose columns are axes and origin in LPS, as OpenIGTLink's in RAS.
void set_ras(igtl::Matrix4x4& matrix, const glm::dmat3& axes, const glm::dvec3& origin_mm) {
    igtl::IdentityMatrix(matrix);
    for (int column = 0; column < 4; ++column) {
        const glm::dvec3 ras = lps_to_ras(column < 3 ? axes[column] : origin_mm);
        for (int row = 0; row < 3; ++row) matrix[row][column] = static_cast<float>(ras[row]);
    }
}

IgtlMessage packed(igtl::MessageBase& message, const std::string& name) {
    message.SetTimeStamp(0, 0);
    message.SetDeviceName(name.substr(0, longest_name).c_str());
    message.Pack();
    const auto* const first = static_cast<const std::uint8_t*>(message.GetPackPointer());
    return {first, first + message.GetPackSize()};
}

}  // namespace

void stamp(IgtlMessage& message, std::chrono::system_clock::time_point sent) {
    using std::chrono::nanoseconds;
    constexpr std::size_t at = 34;  // of the header: seconds, then 2^-32 s, big endian
    const auto since = std::chrono::duration_cast<nanoseconds>(sent.time_since_epoch()).count();
    const auto whole_s = static_cast<std::uint64_t>(since) / 1'000'000'000U;
    const auto part = (static_cast<std::uint64_t>(since) % 1'000'000'000U << 32U) / 1'000'000'000U;
    const std::uint64_t bits = whole_s << 32U | part;
    for (std::size_t i = 0; i < sizeof bits; ++i)
        message.at(at + i) = static_cast<std::uint8_t>(bits >> (56U - 8U * i));
}

glm::dmat3 axes_about(const glm::dvec3& axis) {
    // Duff et al. 2017, "Building an orthonormal basis, revisited", J. Computer Graphics Techniques 6(1).
    const double sign = axis.z < 0.0 ? -1.0 : 1.0;
    const double a = -1.0 / (sign + axis.z);
    const double b = axis.x * axis.y * a;
    return {{1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x},
            {b, sign + axis.y * axis.y * a, -axis.y},
            axis};
}

IgtlMessage transform_message(const std::string& name, const glm::dvec3& origin_mm, const glm::dmat3& axes) {
    igtl::Matrix4x4 matrix;
    set_ras(matrix, axes, origin_mm);
    const igtl::TransformMessage::Pointer message = igtl::TransformMessage::New();
    message->SetMatrix(matrix);
    return packed(*message, name);
}

IgtlMessage image_message(const std::string& name, const Grid& grid, const ReducedBox& box,
                          std::span<const std::uint8_t> values) {
    // The position of an image is that of its centre.
    const glm::dvec3 centre_mm =
        grid.origin_mm + 0.5 * grid.spacing_mm * glm::dvec3(grid.size_voxels - glm::ivec3(1));
    igtl::Matrix4x4 matrix;
    set_ras(matrix, glm::dmat3(1.0), centre_mm);
    const igtl::ImageMessage::Pointer message = igtl::ImageMessage::New();
    const glm::ivec3 size = box.size();
    if (values.size() != static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                             static_cast<std::size_t>(size.z))
        throw std::invalid_argument("an image takes a value for each voxel of its box");
    message->SetDimensions(grid.size_voxels.x, grid.size_voxels.y, grid.size_voxels.z);
    message->SetSubVolume(size.x, size.y, size.z, box.first.x, box.first.y, box.first.z);
    const auto spacing_mm = static_cast<float>(grid.spacing_mm);
    message->SetSpacing(spacing_mm, spacing_mm, spacing_mm);
    message->SetMatrix(matrix);
    message->SetScalarTypeToUint8();
    message->AllocateScalars();
    std::memcpy(message->GetScalarPointer(), values.data(), values.size());
    return packed(*message, name);
}

IgtlMessage string_message(const std::string& name, const std::string& text) {
    constexpr std::uint16_t utf_8 = 106;  // IANA's number
    const igtl::StringMessage::Pointer message = igtl::StringMessage::New();
    message->SetEncoding(utf_8);
    message->SetString(text.substr(0, longest_text).c_str());
    return packed(*message, name);
}

IgtlMessage status_message(const std::string& name, bool is_well, const std::string& text) {
    const igtl::StatusMessage::Pointer message = igtl::StatusMessage::New();
    message->SetCode(is_well ? igtl::StatusMessage::STATUS_OK : igtl::StatusMessage::STATUS_NOT_READY);
    // The library sends uninitialised memory for members that are not set.
    message->SetSubCode(0);
    message->SetErrorName("");
    message->SetStatusString(text.c_str());
    return packed(*message, name);
}

}  // namespace osteomill
