#include "analysis/surface/mesh_file.h"

#include <gmock/gmock.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "common/files/atomic_file.h"
#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace osteomill {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using testing::text_of;

/// A tetrahedron with a corner at the origin and three along the axes.
SurfaceMesh tetrahedron() {
    return {.points_mm = {{0, 0, 0}, {1.5F, 0, 0}, {0, 2.25F, 0}, {0, 0, -700.125F}},
            .triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

template <typename Value>
Value at(const std::string& bytes, std::size_t offset) {
    Value value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

TEST(MeshFile, StlIsBinaryAsItsSpecificationSays) {
    const testing::TemporaryFolder folder;
    write_mesh(folder / "a.stl", tetrahedron());
    const std::string bytes = text_of(folder / "a.stl");
    ASSERT_EQ(bytes.size(), 80U + 4U + 4U * 50U);
    EXPECT_FALSE(bytes.starts_with("solid"));
    EXPECT_THAT(bytes.substr(0, 80), HasSubstr("SPACE=LPS"));
    EXPECT_EQ(at<std::uint32_t>(bytes, 80), 4U);
    EXPECT_EQ(at<glm::vec3>(bytes, 84), glm::vec3(0, 0, 1)) << "normal of the first triangle";
    EXPECT_EQ(at<glm::vec3>(bytes, 84 + 12 + 24), glm::vec3(0, 2.25F, 0)) << "its third corner";
    EXPECT_EQ(at<glm::vec3>(bytes, 84 + 50 + 12 + 12), glm::vec3(0, 0, -700.125F));
}

TEST(MeshFile, PlyHasPointsWithNormalsAndTriangles) {
    const testing::TemporaryFolder folder;
    write_mesh(folder / "a.ply", tetrahedron());
    const std::string bytes = text_of(folder / "a.ply");
    EXPECT_THAT(bytes, StartsWith("ply\nformat binary_little_endian 1.0\n"));
    EXPECT_THAT(bytes, HasSubstr("element vertex 4\n"));
    EXPECT_THAT(bytes, HasSubstr("element face 4\n"));
    const std::string end = "end_header\n";
    const std::size_t points = bytes.find(end) + end.size();
    const std::size_t faces = points + 4 * 24;
    ASSERT_EQ(bytes.size(), faces + 4 * 13);
    EXPECT_EQ(at<glm::vec3>(bytes, points + 3 * 24), glm::vec3(0, 0, -700.125F));
    EXPECT_NEAR(glm::length(at<glm::vec3>(bytes, points + 2 * 24 + 12)), 1.0F, 1e-6F);
    EXPECT_EQ(bytes[faces + 13], 3);
    EXPECT_EQ(at<std::uint32_t>(bytes, faces + 13 + 5), 3U);
}

TEST(MeshFile, ObjReadsBackAsTheSamePointsAndTriangles) {
    const testing::TemporaryFolder folder;
    const SurfaceMesh mesh = tetrahedron();
    write_mesh(folder / "a.obj", mesh);
    std::vector<glm::vec3> points;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::ifstream in(folder / "a.obj");
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            glm::vec3 point;
            words >> point.x >> point.y >> point.z;
            points.push_back(point);
        } else if (kind == "f") {
            std::array<std::uint32_t, 3> triangle{};
            for (std::uint32_t& corner : triangle) {
                std::string word;
                words >> word;
                corner = static_cast<std::uint32_t>(std::stoul(word)) - 1;
                EXPECT_THAT(word, ::testing::EndsWith("//" + std::to_string(corner + 1)));
            }
            triangles.push_back(triangle);
        }
    }
    EXPECT_EQ(points, mesh.points_mm);
    EXPECT_EQ(triangles, mesh.triangles);
}

TEST(MeshFile, ReplacesALinkOfANameThatNobodyGave) {
    const testing::TemporaryFolder folder;
    write_atomic_file(folder / "elsewhere", "old");
    std::filesystem::create_symlink("elsewhere", folder / "a.stl");
    write_mesh(folder / "a.stl", tetrahedron(), Link::replace);
    EXPECT_FALSE(std::filesystem::is_symlink(folder / "a.stl"));
    EXPECT_EQ(std::filesystem::file_size(folder / "elsewhere"), 3U);
}

TEST(MeshFile, LeavesTheOldFileWhereItCannotBeWritten) {
    const testing::TemporaryFolder folder;
    EXPECT_THROW(write_mesh(folder / "a.xyz", tetrahedron()), std::invalid_argument);
    EXPECT_FALSE(is_mesh_name("a.xyz"));
    EXPECT_TRUE(is_mesh_name("a.ply"));
    try {
        write_mesh(folder / "missing" / "a.stl", tetrahedron());
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("a.stl: cannot be written: No such file"));
    }
    write_atomic_file(folder / "a.stl", "old");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "and no part";
}

}  // namespace
}  // namespace osteomill
