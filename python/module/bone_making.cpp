#include "python/module/bone_making.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/bone/bone_builder.h"
#include "common/scene/stiffness_relation.h"
#include "imaging/bone_file/carved_bone.h"
#include "python/module/arrays.h"
#include "python/module/released_lock.h"

namespace osteomill::python {

namespace {

constexpr auto own_layout = py::array::forcecast;
using Bytes3 = py::array_t<std::uint8_t, own_layout>;
using Floats3 = py::array_t<double, own_layout>;

std::string words_of(const py::handle& value) {
    return std::string(py::str(value));
}

/// Fractions, 0 to 255, from an array of such numbers, or from one that only says where bone is.
Bytes3 fractions_of(const py::array& array) {
    if (array.ndim() != 3 || array.size() == 0)
        throw std::invalid_argument("fraction: takes an array (i, j, k) of voxels, not one of shape " +
                                    words_of(array.attr("shape")));
    const char kind = array.dtype().kind();
    if (kind == 'b') return Bytes3(array.attr("astype")("uint8").attr("__mul__")(255));
    if (kind == 'u' && array.itemsize() == 1) return Bytes3(array);
    throw std::invalid_argument("fraction: takes uint8, 0 to 255 left of each voxel, or bool, not " +
                                words_of(array.dtype()));
}

void require_shape(const py::array& array, const py::array& of_fraction, const char* argument) {
    if (!array.attr("shape").equal(of_fraction.attr("shape")))
        throw std::invalid_argument(fmt::format("{}: takes an array {}, as fraction is, not {}", argument,
                                                words_of(of_fraction.attr("shape")),
                                                words_of(array.attr("shape"))));
}

[[noreturn]] void refuse_stiffness(double value) {
    throw std::invalid_argument(fmt::format(
        "stiffness: lies within {:g} to {:g} (1: the bone that a burr's coefficients hold for), not {:g}",
        stiffness_per_code, largest_relative_stiffness, value));
}

std::uint8_t code_of(double stiffness) {
    const double code = std::round(stiffness / stiffness_per_code);
    if (!(code >= 1.0 && code <= 255.0)) refuse_stiffness(stiffness);
    return static_cast<std::uint8_t>(code);
}

int edge_of(const py::array& array, int axis) {
    constexpr py::ssize_t most = 1 << 16;
    if (array.shape(axis) > most)
        throw std::invalid_argument(
            fmt::format("fraction: takes up to {} voxels along an axis, not {}", most, array.shape(axis)));
    return static_cast<int>(array.shape(axis));
}

}  // namespace

BoneView bone_from_array(const py::array& fraction, double spacing_mm, const py::handle& origin_mm,
                         const py::object& stiffness, const std::optional<py::array>& tissue) {
    const Bytes3 left = fractions_of(fraction);
    const Grid grid{.size_voxels = {edge_of(left, 0), edge_of(left, 1), edge_of(left, 2)},
                    .spacing_mm = spacing_mm,
                    .origin_mm = vector_of(origin_mm, "origin_mm")};
    Bytes3 labels = left;  // or a value below bone's, so that something can be displayed
    const bool is_labelled = tissue.has_value();
    if (tissue) {
        require_shape(*tissue, fraction, "tissue");
        if (tissue->dtype().kind() != 'u' || tissue->itemsize() != 1)
            throw std::invalid_argument("tissue: takes uint8, a label of each voxel, not " +
                                        words_of(tissue->dtype()));
        labels = Bytes3(*tissue);
    }
    Floats3 stiffnesses({0, 0, 0});
    const bool has_stiffnesses = py::isinstance<py::array>(stiffness);
    double one_stiffness = 1.0;
    if (has_stiffnesses) {
        stiffnesses = Floats3(stiffness.cast<py::array>());
        require_shape(stiffnesses, fraction, "stiffness");
    } else if (!stiffness.is_none()) {
        one_stiffness = stiffness.cast<double>();
        if (!(one_stiffness >= stiffness_per_code && one_stiffness <= largest_relative_stiffness))
            refuse_stiffness(one_stiffness);
    }
    const auto of_fraction = left.unchecked<3>();
    const auto of_label = labels.unchecked<3>();
    const auto of_stiffness = stiffnesses.unchecked<3>();
    const ReleasedLock released;
    BoneBuilder builder = has_stiffnesses ? BoneBuilder::heterogeneous(grid, stiffness_per_code, is_labelled)
                                          : BoneBuilder::homogeneous(grid, one_stiffness, is_labelled);
    Bone bone = filled(std::move(builder), grid, [&](const glm::ivec3& voxel) {
        VoxelValues values{.fraction = of_fraction(voxel.x, voxel.y, voxel.z)};
        if (values.fraction == 0) return values;
        if (has_stiffnesses) values.stiffness = code_of(of_stiffness(voxel.x, voxel.y, voxel.z));
        if (is_labelled) values.tissue = of_label(voxel.x, voxel.y, voxel.z);
        return values;
    });
    if (bone.stored_bricks() == 0)
        throw std::invalid_argument("fraction: there is no bone: every voxel is 0");
    return BoneView(std::move(bone));
}

void save_bone_of(const BoneView& view, const std::filesystem::path& file) {
    const ReleasedLock released;
    std::unique_lock<std::mutex> held;
    if (view.session() != nullptr) held = taken(view.session()->busy());
    save_carved_bone(file, view.bone());
}

}  // namespace osteomill::python
