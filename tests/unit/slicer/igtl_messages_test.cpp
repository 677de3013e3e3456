#include "slicer/igtl_messages.h"

#include <gtest/gtest.h>
#include <openigtlink/igtlImageMessage.h>
#include <openigtlink/igtlStatusMessage.h>
#include <openigtlink/igtlTransformMessage.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>
#include <stdexcept>

#include "common/igtl/igtl_stream.h"

namespace osteomill {
namespace {

/// The message as a client of the library unpacks it, the CRC checked.
template <typename Message>
typename Message::Pointer unpacked(const IgtlMessage& bytes) {
    auto header = igtl::MessageHeader::New();
    header->InitPack();
    std::memcpy(header->GetPackPointer(), bytes.data(), static_cast<std::size_t>(header->GetPackSize()));
    header->Unpack();
    auto message = Message::New();
    message->SetMessageHeader(header);
    message->AllocatePack();
    std::memcpy(message->GetPackBodyPointer(), bytes.data() + header->GetPackSize(),
                static_cast<std::size_t>(message->GetPackBodySize()));
    EXPECT_TRUE(message->Unpack(1) & igtl::MessageHeader::UNPACK_BODY);
    return message;
}

TEST(IgtlMessages, HaveNoTimeUntilTheyAreSentAndThenThatOne) {
    const Grid grid{.size_voxels = {2, 2, 2}, .spacing_mm = 0.5};
    const std::vector<std::uint8_t> values(8, 1);
    for (IgtlMessage message : {transform_message("Burr", glm::dvec3(0.0), glm::dmat3(1.0)),
                                image_message("Bone", grid, {{0, 0, 0}, {2, 2, 2}}, values),
                                string_message("Session", "text"), status_message("BurrStatus", true, "")}) {
        const auto bits = [&message] {
            std::uint64_t sum = 0;
            for (std::size_t i = 34; i < 42; ++i) sum = sum << 8U | message.at(i);
            return sum;
        };
        EXPECT_EQ(bits(), 0U) << "none, and no bytes of memory";
        stamp(message, std::chrono::system_clock::time_point(std::chrono::milliseconds(1'700'000'000'250)));
        EXPECT_EQ(bits(), 1'700'000'000U * (std::uint64_t{1} << 32U) + (std::uint64_t{1} << 30U));
        EXPECT_EQ(message[42], 0) << "the size of the body follows";
    }
}

TEST(IgtlMessages, AnImageTakesAValueAVoxelOfItsBoxAndNoMore) {
    const Grid grid{.size_voxels = {2, 2, 2}, .spacing_mm = 0.5};
    const std::vector<std::uint8_t> values(8, 1);
    EXPECT_THROW(image_message("Bone", grid, {{0, 0, 0}, {1, 1, 1}}, values), std::invalid_argument);
}

TEST(IgtlMessages, AnImageLiesInRasWithItsCentreAsPosition) {
    const Grid grid{.size_voxels = {10, 20, 31}, .spacing_mm = 0.5, .origin_mm = {-3.0, 7.0, 100.0}};
    const ReducedBox box{{2, 3, 4}, {5, 5, 6}};
    std::vector<std::uint8_t> values(3 * 2 * 2);
    std::iota(values.begin(), values.end(), std::uint8_t{1});
    const auto image = unpacked<igtl::ImageMessage>(image_message("Bone", grid, box, values));
    EXPECT_STREQ(image->GetDeviceName(), "Bone");
    int size[3], part[3], offset[3];
    image->GetDimensions(size);
    image->GetSubVolume(part, offset);
    EXPECT_EQ(glm::ivec3(size[0], size[1], size[2]), grid.size_voxels);
    EXPECT_EQ(glm::ivec3(part[0], part[1], part[2]), box.size());
    EXPECT_EQ(glm::ivec3(offset[0], offset[1], offset[2]), box.first);
    EXPECT_EQ(std::memcmp(image->GetScalarPointer(), values.data(), values.size()), 0);
    float spacing_mm[3];
    image->GetSpacing(spacing_mm);
    EXPECT_EQ(spacing_mm[2], 0.5f);
    igtl::Matrix4x4 matrix;
    image->GetMatrix(matrix);
    // By hand: the centre is at LPS (-3 + 4.5 x 0.5, 7 + 9.5 x 0.5, 100 + 15 x 0.5) = (-0.75, 11.75, 107.5).
    EXPECT_FLOAT_EQ(matrix[0][3], 0.75f);
    EXPECT_FLOAT_EQ(matrix[1][3], -11.75f);
    EXPECT_FLOAT_EQ(matrix[2][3], 107.5f);
    EXPECT_FLOAT_EQ(matrix[0][0], -1.0f);
    EXPECT_FLOAT_EQ(matrix[1][1], -1.0f);
    EXPECT_FLOAT_EQ(matrix[2][2], 1.0f);
}

TEST(IgtlMessages, ATransformHasItsAxesAsColumnsInRas) {
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, -0.8));
    const auto message =
        unpacked<igtl::TransformMessage>(transform_message("Burr", {1.0, 2.0, 3.0}, axes_about(axis)));
    igtl::Matrix4x4 matrix;
    message->GetMatrix(matrix);
    EXPECT_FLOAT_EQ(matrix[0][3], -1.0f);
    EXPECT_FLOAT_EQ(matrix[1][3], -2.0f);
    EXPECT_FLOAT_EQ(matrix[2][3], 3.0f);
    EXPECT_FLOAT_EQ(matrix[0][2], static_cast<float>(-axis.x));
    EXPECT_FLOAT_EQ(matrix[1][2], static_cast<float>(-axis.y));
    EXPECT_FLOAT_EQ(matrix[2][2], static_cast<float>(axis.z));
}

TEST(IgtlMessages, AxesAreSquareAndRightHandedAboutAnyDirection) {
    std::mt19937 random(3);
    std::normal_distribution<double> any;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(any(random), any(random), any(random)));
        const glm::dmat3 axes = axes_about(axis);
        EXPECT_EQ(axes[2], axis);
        EXPECT_NEAR(glm::length(glm::cross(axes[0], axes[1]) - axis), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(axes[0]), 1.0, 1e-12);
    }
    EXPECT_NEAR(glm::length(axes_about({0.0, 0.0, -1.0})[0]), 1.0, 1e-12);
}

TEST(IgtlMessages, AStatusNamesNoError) {
    const auto status = unpacked<igtl::StatusMessage>(status_message("Session", true, "ready"));
    EXPECT_STREQ(status->GetStatusString(), "ready");
    EXPECT_STREQ(status->GetErrorName(), "");
    EXPECT_EQ(status->GetSubCode(), 0);
}

TEST(IgtlMessages, TextComesBackAsItWas) {
    std::string name;
    std::string text;
    IgtlStream stream({.wants = [](const std::string& type, const std::string&) { return type == "STRING"; },
                       .take =
                           [&](const IgtlMessageView& message) {
                               name = message.name;
                               text = text_of_string_message(message.content).value_or("damaged");
                           },
                       .damaged = [] { FAIL(); }});
    EXPECT_TRUE(stream.feed(string_message("Session", R"({"fault": "zu weit: 3 µm"})")));
    EXPECT_EQ(name, "Session");
    EXPECT_EQ(text, R"({"fault": "zu weit: 3 µm"})");
}

}  // namespace
}  // namespace osteomill
