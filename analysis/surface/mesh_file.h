// Mesh file writer: triangles for other programs to open, as STL, PLY or OBJ, by the name's ending.
//
// All are in mm and say SPACE=LPS, from which 3D Slicer knows that they are in patient LPS; binary numbers
// are little endian.
//
//   .stl   binary: for each triangle its normal and its three corners
//   .ply   binary: points with normals, triangles of them
//   .obj   text: points with normals, triangles of them
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>

#include "analysis/surface/surface_mesh.h"
#include "common/files/atomic_file.h"

namespace osteomill {

/// Whether write_mesh knows the ending of this name.
bool is_mesh_name(const std::filesystem::path& path);

/// Whether this is one of the endings, and nothing else: ".stl".
bool is_mesh_ending(const std::string& ending);

/// The endings, as options name them.
inline constexpr std::string_view mesh_endings = ".stl, .ply or .obj";
inline constexpr std::array mesh_ending_list{".stl", ".ply", ".obj"};

/// Replaces the file as a whole. Throws std::runtime_error with one line that names it if it cannot be
/// written, std::invalid_argument for another ending.
void write_mesh(const std::filesystem::path& path, const SurfaceMesh& mesh, Link link = Link::follow);

}  // namespace osteomill
