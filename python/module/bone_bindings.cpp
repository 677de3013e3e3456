// Bone in Python: geometry of its grid, and copies of its channels.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "common/bone/bone_builder.h"
#include "common/scene/stiffness_relation.h"
#include "imaging/bone_file/carved_bone.h"
#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/python_bone.h"
#include "python/module/released_lock.h"

namespace osteomill::python {

/// The bone whose voxels are those of the arrays, (i, j, k): the fraction left of each (uint8, or bool), its
/// relative stiffness (an array, one number, or None: 1), its tissue's label. Throws std::invalid_argument
/// that names the argument.
PythonBone bone_from_array(const pybind11::array& fraction, double spacing_mm,
                           const pybind11::handle& origin_mm, const pybind11::object& stiffness,
                           const std::optional<pybind11::array>& tissue);

/// Saves the present bone, voxel by voxel, for Case(bone=...) and haptic_server --bone. Throws ImagingError
/// in one line if it cannot be written.
void save_bone_of(const PythonBone& view, const std::filesystem::path& file);

namespace {

/// Voxels from `from` up to, not with, `to`.
struct Box {
    glm::ivec3 from{0};
    glm::ivec3 to{0};

    glm::ivec3 size() const { return to - from; }
    std::size_t voxels() const {
        const glm::ivec3 n = size();
        return static_cast<std::size_t>(n.x) * static_cast<std::size_t>(n.y) * static_cast<std::size_t>(n.z);
    }
    std::size_t index(const glm::ivec3& voxel) const {
        const glm::ivec3 at = voxel - from;
        return static_cast<std::size_t>(at.x) +
               static_cast<std::size_t>(size().x) *
                   (static_cast<std::size_t>(at.y) +
                    static_cast<std::size_t>(size().y) * static_cast<std::size_t>(at.z));
    }
};

using BoxArgument = std::optional<std::array<std::array<int, 3>, 2>>;

/// The whole grid if none is given. The box may reach beyond the grid.
Box box_of(const BoxArgument& argument, const Grid& grid) {
    if (!argument) return {glm::ivec3(0), grid.size_voxels};
    const auto& [from, to] = *argument;
    const Box box{{from[0], from[1], from[2]}, {to[0], to[1], to[2]}};
    constexpr int farthest = 1 << 20;
    if (glm::any(glm::lessThan(box.to, box.from)) ||
        glm::any(glm::lessThan(box.from, glm::ivec3(-farthest))) ||
        glm::any(glm::greaterThan(box.to, glm::ivec3(farthest))))
        throw std::invalid_argument(
            fmt::format("box: takes the first voxel and the one past the last, ((i, j, k), (i, j, k)), not "
                        "(({}, {}, {}), ({}, {}, {}))",
                        from[0], from[1], from[2], to[0], to[1], to[2]));
    return box;
}

/// (i, j, k), i fastest in memory as in the bone: `.T` is (k, j, i) without a copy.
template <typename Value>
py::array_t<Value> empty_array(const Box& box) {
    const glm::ivec3 n = box.size();
    return py::array_t<Value, py::array::f_style>({n.x, n.y, n.z});
}

/// Calls `copy(slot, offset in the brick, voxel, count)` for each row of voxels along x that lies in both box
/// and bone.
template <typename Copy>
void for_each_row(const Bone& bone, const Box& box, const Copy& copy) {
    const glm::ivec3 from = glm::max(box.from, glm::ivec3(0));
    const glm::ivec3 to = glm::min(box.to, bone.grid().size_voxels);
    if (glm::any(glm::greaterThanEqual(from, to))) return;
    for (int z = from.z; z < to.z; ++z)
        for (int y = from.y; y < to.y; ++y)
            for (int x = from.x; x < to.x;) {
                const int end = std::min(to.x, (x / brick_edge_voxels + 1) * brick_edge_voxels);
                const std::int32_t slot = bone.slot(glm::ivec3(x, y, z) / brick_edge_voxels);
                if (slot != BoneContent::no_slot)
                    copy(slot, offset_in_brick({x, y, z}), glm::ivec3(x, y, z),
                         static_cast<std::size_t>(end - x));
                x = end;
            }
}

/// Reads a bone that no other thread changes meanwhile, without the interpreter's lock.
template <typename Look>
void look(const PythonBone& view, const Look& look_at) {
    const ReleasedLock released;
    std::unique_lock<std::mutex> held;
    if (view.session() != nullptr) held = taken(view.session()->busy());
    look_at(view.bone());
}

/// A copy of a channel: `copy(bone, slot, offset in the brick, count, out)` for each row, 0 if no bone is
/// stored.
template <typename Value, typename Copy>
py::array channel(const PythonBone& view, const BoxArgument& argument, const Copy& copy) {
    const Box box = box_of(argument, view.bone().grid());
    auto array = empty_array<Value>(box);
    Value* out = array.mutable_data();
    look(view, [&](const Bone& bone) {
        std::fill_n(out, box.voxels(), Value{0});
        for_each_row(bone, box,
                     [&](std::int32_t slot, std::size_t offset, const glm::ivec3& voxel, std::size_t count) {
                         copy(bone, slot, offset, count, out + box.index(voxel));
                     });
    });
    return array;
}

py::array fraction(const PythonBone& view, const BoxArgument& box) {
    return channel<std::uint8_t>(
        view, box,
        [](const Bone& bone, std::int32_t slot, std::size_t offset, std::size_t count, std::uint8_t* out) {
            std::copy_n(bone.fractions(slot).data() + offset, count, out);
        });
}

py::array tissue(const PythonBone& view, const BoxArgument& box) {
    return channel<std::uint8_t>(
        view, box,
        [](const Bone& bone, std::int32_t slot, std::size_t offset, std::size_t count, std::uint8_t* out) {
            if (const ByteBrick* labels = bone.content().tissues_of(slot))
                std::copy_n(labels->data() + offset, count, out);
        });
}

py::array stiffness(const PythonBone& view, const BoxArgument& box) {
    return channel<float>(
        view, box,
        [](const Bone& bone, std::int32_t slot, std::size_t offset, std::size_t count, float* out) {
            for (std::size_t i = 0; i < count; ++i)
                out[i] = static_cast<float>(bone.content().stiffness_in(slot, offset + i));
        });
}

py::array hu(const PythonBone& view, const BoxArgument& argument) {
    const Grid& grid = view.bone().grid();
    const BoneSource* source = view.source();
    if (source == nullptr || !has_ct(*source, grid))
        throw std::invalid_argument(
            "this bone has no CT numbers; those of a case that was made from a scan, or of the tooth, do");
    const Box box = box_of(argument, grid);
    auto array = empty_array<std::int16_t>(box);
    std::int16_t* out = array.mutable_data();
    const ReleasedLock released;
    std::fill_n(out, box.voxels(), air_hu);
    const glm::ivec3 from = glm::max(box.from, glm::ivec3(0));
    const glm::ivec3 to = glm::min(box.to, grid.size_voxels);
    if (glm::any(glm::greaterThanEqual(from, to))) return array;
    read_ct(*source, to.z, [&](int z, std::span<const std::int16_t> slice) {
        if (z < from.z) return;
        for (int y = from.y; y < to.y; ++y)
            std::copy_n(slice.data() + from.x + std::ptrdiff_t{grid.size_voxels.x} * y, to.x - from.x,
                        out + box.index({from.x, y, z}));
    });
    return array;
}

}  // namespace

void bind_bone(py::module_& module) {
    py::class_<PythonBone>(module, "Bone",
                           R"(A bone on a grid of voxels: what is left of it, and what it is made of.

Voxel (i, j, k) is a cube of edge `spacing_mm`; its centre lies at `origin_mm + spacing_mm * (i, j, k)` in patient LPS
(x to the patient's left, y to the back, z up). Arrays are copies of shape (i, j, k) with i fastest in memory; `.T` is
(k, j, i), the order of 3D Slicer, without a copy and without a mirror. `box` is ((i0, j0, k0), (i1, j1, k1)): the first
voxel and the one past the last; it may reach beyond the grid, where there is nothing. None: the whole grid.)")
        .def_static("from_array", &bone_from_array, py::arg("fraction"), py::kw_only(), py::arg("spacing_mm"),
                    py::arg("origin_mm") = py::make_tuple(0.0, 0.0, 0.0), py::arg("stiffness") = py::none(),
                    py::arg("tissue") = py::none(),
                    R"(A bone of one's own voxels, (i, j, k).

fraction: uint8, what is left of each, 0 to 255; or bool: all or nothing. spacing_mm: edge of a voxel. origin_mm (3,): centre of the
first, patient LPS. stiffness: relative, 0.02 to 5.1 in steps of 0.02, an array or one number; None: 1. tissue: uint8 labels.
To mill it, save it and name the file: bone.save("own.nrrd"), Case("cube", bone="own.nrrd"). BadInput: names the argument.)")
        .def("save", &save_bone_of, py::arg("file"),
             "Writes it into a file (.nrrd), as it is, voxel by voxel, for Case(..., bone=file) and "
             "haptic_server --bone; "
             "3D Slicer reads it, too. Fault: it cannot be written.")
        .def_property_readonly(
            "spacing_mm", [](const PythonBone& view) { return view.bone().grid().spacing_mm; },
            "Edge of a voxel, mm.")
        .def_property_readonly(
            "origin_mm", [](const PythonBone& view) { return array_of(view.bone().grid().origin_mm); },
            "Centre of voxel (0, 0, 0), patient LPS, mm: (3,).")
        .def_property_readonly(
            "shape",
            [](const PythonBone& view) {
                const glm::ivec3& n = view.bone().grid().size_voxels;
                return py::make_tuple(n.x, n.y, n.z);
            },
            "Voxels along i, j and k.")
        .def_property_readonly(
            "volume_mm3",
            [](const PythonBone& view) {
                double volume_mm3 = 0.0;
                look(view, [&](const Bone& bone) { volume_mm3 = bone_volume_mm3(bone); });
                return volume_mm3;
            },
            "Volume that is left, mm^3.")
        .def("fraction", &fraction, py::arg("box") = py::none(),
             "The part that is left of each voxel, 0 (nothing) to 255 (all): uint8 (i, j, k).")
        .def("stiffness", &stiffness, py::arg("box") = py::none(),
             "Relative stiffness of each voxel's bone (1: the bone that a burr's coefficients hold for), "
             "whether it is left "
             "or not; 0 where none was: float32 (i, j, k).")
        .def("tissue", &tissue, py::arg("box") = py::none(),
             "Label of each voxel's tissue (see Case.tissues), 0 where there is none: uint8 (i, j, k).")
        .def("hu", &hu, py::arg("box") = py::none(),
             "CT numbers of the scan that the bone was made from, HU, -1000 beyond it: int16 (i, j, k). They "
             "are not kept but "
             "read, or made, once more up to the box's last slice, which takes a second for the tooth. "
             "ValueError: there are none.")
        .def(
            "checksum",
            [](const PythonBone& view) {
                std::uint64_t sum = 0;
                look(view, [&](const Bone& bone) { sum = checksum(bone); });
                return fmt::format("{:016x}", sum);
            },
            "Checksum of the remaining bone, 16 hex digits: equal for equal bones, and the `bone_checksum` "
            "of haptic_server "
            "--json.")
        .def("__repr__", [](const PythonBone& view) {
            const Grid& grid = view.bone().grid();
            return fmt::format("<Bone of {} x {} x {} voxels of {:g} mm>", grid.size_voxels.x,
                               grid.size_voxels.y, grid.size_voxels.z, grid.spacing_mm);
        });
}

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

PythonBone bone_from_array(const py::array& fraction, double spacing_mm, const py::handle& origin_mm,
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
    return PythonBone(std::move(bone));
}

void save_bone_of(const PythonBone& view, const std::filesystem::path& file) {
    const ReleasedLock released;
    std::unique_lock<std::mutex> held;
    if (view.session() != nullptr) held = taken(view.session()->busy());
    save_carved_bone(file, view.bone());
}

}  // namespace osteomill::python
