// Bones from arrays, and bones into files, for Python.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <filesystem>
#include <optional>

#include "python/module/bone_view.h"

namespace osteomill::python {

/// The bone whose voxels are those of the arrays, (i, j, k): the fraction left of each (uint8, or bool), its
/// relative stiffness (an array, one number, or None: 1), its tissue's label. Throws std::invalid_argument
/// that names the argument.
BoneView bone_from_array(const pybind11::array& fraction, double spacing_mm,
                         const pybind11::handle& origin_mm, const pybind11::object& stiffness,
                         const std::optional<pybind11::array>& tissue);

/// Saves the present bone, voxel by voxel, for Case(bone=...) and haptic_server --bone. Throws ImagingError
/// in one line if it cannot be written.
void save_bone_of(const BoneView& view, const std::filesystem::path& file);

}  // namespace osteomill::python
