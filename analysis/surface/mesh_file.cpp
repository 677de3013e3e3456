#include "analysis/surface/mesh_file.h"

#include <fmt/format.h>

#include <bit>
#include <glm/geometric.hpp>
#include <span>
#include <stdexcept>
#include <string>

#include "common/text/append.h"

namespace osteomill {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::size_t bytes_at_once = 1u << 20;

/// Gathers bytes and writes them a good deal at a time.
class Output {
  public:
    Output(const std::filesystem::path& path, Link link) : file_(path, link) {}
    template <typename Value>
    void add(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
        flush_if_full();
    }
    template <typename... Values>
    void print(fmt::format_string<Values...> format, Values&&... values) {
        append_formatted(bytes_, format, std::forward<Values>(values)...);
        flush_if_full();
    }
    void commit() {
        flush();
        file_.commit();
    }

  private:
    void flush_if_full() {
        if (bytes_.size() >= bytes_at_once) flush();
    }
    void flush() {
        file_.write(std::as_bytes(std::span(bytes_)));
        bytes_.clear();
    }

    AtomicFile file_;
    std::string bytes_;
};

void write_stl(Output& out, const SurfaceMesh& mesh) {
    // Readers take a file that begins with "solid" for a text.
    constexpr std::string_view title = "Osteomill, mm. SPACE=LPS";
    std::array<char, 80> header{};
    title.copy(header.data(), header.size());
    out.add(header);
    out.add(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) {
        const glm::vec3& a = mesh.points_mm[triangle[0]];
        const glm::vec3 area = glm::cross(mesh.points_mm[triangle[1]] - a, mesh.points_mm[triangle[2]] - a);
        const float length = glm::length(area);
        out.add(length > 0.0F ? area / length : glm::vec3(0.0F));
        for (const std::uint32_t point : triangle) out.add(mesh.points_mm[point]);
        out.add(std::uint16_t{0});
    }
}

void write_ply(Output& out, const SurfaceMesh& mesh) {
    out.print(
        "ply\nformat binary_little_endian 1.0\ncomment Osteomill, mm. SPACE=LPS\nelement vertex {}\n"
        "property float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
        "property float nz\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.points_mm.size(), mesh.triangles.size());
    const std::vector<glm::vec3> normals = vertex_normals(mesh);
    for (std::size_t i = 0; i < normals.size(); ++i) {
        out.add(mesh.points_mm[i]);
        out.add(normals[i]);
    }
    for (const auto& triangle : mesh.triangles) {
        out.add(std::uint8_t{3});
        out.add(triangle);
    }
}

void write_obj(Output& out, const SurfaceMesh& mesh) {
    out.print("# Osteomill, mm. SPACE=LPS\n");
    for (const glm::vec3& point : mesh.points_mm) out.print("v {} {} {}\n", point.x, point.y, point.z);
    for (const glm::vec3& normal : vertex_normals(mesh))
        out.print("vn {:.4f} {:.4f} {:.4f}\n", normal.x, normal.y, normal.z);
    for (const auto& triangle : mesh.triangles) {
        const std::uint64_t a = std::uint64_t{1} + triangle[0];
        const std::uint64_t b = std::uint64_t{1} + triangle[1];
        const std::uint64_t c = std::uint64_t{1} + triangle[2];
        out.print("f {0}//{0} {1}//{1} {2}//{2}\n", a, b, c);
    }
}

using Write = void (*)(Output& out, const SurfaceMesh& mesh);

/// nullptr: no ending of a mesh.
Write writer_for(const std::filesystem::path& path) {
    if (path.extension() == ".stl") return write_stl;
    if (path.extension() == ".ply") return write_ply;
    if (path.extension() == ".obj") return write_obj;
    return nullptr;
}

}  // namespace

bool is_mesh_name(const std::filesystem::path& path) {
    return writer_for(path) != nullptr;
}

bool is_mesh_ending(const std::string& ending) {
    const std::filesystem::path name("bone" + ending);
    return name.extension() == ending && is_mesh_name(name);
}

void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh, Link link) {
    const Write write = writer_for(path);
    if (write == nullptr)
        throw std::invalid_argument(
            fmt::format("{}: a surface's name ends in {}", path.string(), mesh_endings));
    Output out(path, link);
    write(out, mesh);
    out.commit();
}

}  // namespace osteomill
