#include "imaging/resampling/specks.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "imaging/bone_from_hu.h"

namespace osteomill::specks_test {
namespace {

constexpr double threshold_hu = 300.0;
const Grid grid{.size_voxels = {40, 30, 20}, .spacing_mm = 0.25};  // 2 mm^3 are 128 voxels

using IsBone = std::function<bool(const glm::ivec3&)>;

std::vector<std::vector<std::int16_t>> slices_of(const IsBone& is_bone) {
    std::vector<std::vector<std::int16_t>> slices;
    for (int z = 0; z < grid.size_voxels.z; ++z) {
        std::vector<std::int16_t>& slice = slices.emplace_back();
        for (int y = 0; y < grid.size_voxels.y; ++y)
            for (int x = 0; x < grid.size_voxels.x; ++x)
                slice.push_back(is_bone({x, y, z}) ? std::int16_t{900} : std::int16_t{100});
    }
    return slices;
}

Specks specks_of(const std::vector<std::vector<std::int16_t>>& slices) {
    SpeckSearch search(grid, threshold_hu);
    for (const auto& slice : slices) search.add(slice);
    EXPECT_FALSE(search.has_given_up());
    return search.found();
}

bool is_in(const glm::ivec3& v, const glm::ivec3& first, const glm::ivec3& end) {
    return v.x >= first.x && v.y >= first.y && v.z >= first.z && v.x < end.x && v.y < end.y && v.z < end.z;
}

TEST(Specks, AreSmallPartsThatTouchNothing) {
    const auto is_bone = [](const glm::ivec3& v) {
        return is_in(v, {0, 0, 0}, {20, 20, 20})      // the bone
               || is_in(v, {30, 3, 3}, {32, 5, 5})    // 8 voxels
               || v == glm::ivec3(25, 25, 10)         // 1
               || is_in(v, {30, 20, 0}, {35, 25, 5})  // 125: a little less than a speck's most
               || is_in(v, {30, 8, 8}, {36, 14, 12})  // 144: no speck
               || v == glm::ivec3(20, 20, 4);         // touches the bone by a corner
    };
    const Specks specks = specks_of(slices_of(is_bone));
    EXPECT_EQ(specks.count, 3U);
    EXPECT_EQ(specks.voxels, 134U);
    auto slices = slices_of(is_bone);
    for (int z = 0; z < grid.size_voxels.z; ++z)
        clear_specks(specks, z, grid.size_voxels.x, slices[static_cast<std::size_t>(z)]);
    EXPECT_EQ(slices[3][3 * 40 + 30], air_hu);
    EXPECT_EQ(slices[10][25 * 40 + 25], air_hu);
    EXPECT_EQ(slices[4][24 * 40 + 34], air_hu);
    EXPECT_EQ(slices[4][20 * 40 + 20], 900);
    EXPECT_EQ(slices[9][9 * 40 + 31], 900);
    EXPECT_EQ(slices[5][9 * 40 + 29], 100) << "what is no bone stays";
    EXPECT_EQ(specks_of(slices).count, 0U);
}

TEST(Specks, AreNotWhatMeetsTheRestFurtherUp) {
    // Two legs that join in the last slice: the thin one looks like a speck until then.
    const auto is_bone = [](const glm::ivec3& v) {
        return is_in(v, {2, 2, 0}, {12, 12, 20}) || (v.x == 20 && v.y == 5) ||
               (v.z == 19 && v.y == 5 && v.x >= 2 && v.x <= 20);
    };
    EXPECT_EQ(specks_of(slices_of(is_bone)).count, 0U);
    const auto apart = [&](const glm::ivec3& v) { return is_bone(v) && v.x != 15; };
    EXPECT_EQ(specks_of(slices_of(apart)).count, 1U);
    EXPECT_EQ(specks_of(slices_of(apart)).voxels, 24U);
}

TEST(Specks, AreNeverTheWholeOfATinyBone) {
    EXPECT_EQ(specks_of(slices_of([](const glm::ivec3& v) { return v == glm::ivec3(5, 5, 5); })).count, 0U);
    EXPECT_EQ(specks_of(slices_of([](const glm::ivec3&) { return false; })).count, 0U);
    EXPECT_EQ(specks_of(slices_of([](const glm::ivec3&) { return true; })).count, 0U);
}

TEST(Specks, AreNotCountedWhereAllIsNoise) {
    const Grid wide{.size_voxels = {2048, 1100, 1}, .spacing_mm = 0.1};
    std::vector<std::int16_t> slice(std::size_t{2048} * 1100);
    for (std::size_t y = 0; y < 1100; y += 2)
        for (std::size_t x = 0; x < 2048; x += 2) slice[y * 2048 + x] = 900;
    SpeckSearch search(wide, threshold_hu);
    for (int i = 0; i < 3; ++i) {
        search.add(slice);
        search.add(std::vector<std::int16_t>(slice.size()));
    }
    EXPECT_TRUE(search.has_given_up());
}

}  // namespace
}  // namespace osteomill::specks_test
