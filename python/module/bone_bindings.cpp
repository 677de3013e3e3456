// Bone in Python: geometry of its grid, and copies of its channels.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "python/module/arrays.h"
#include "python/module/bindings.h"
#include "python/module/bone_making.h"
#include "python/module/bone_view.h"
#include "python/module/released_lock.h"

namespace osteomill::python {

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
void look(const BoneView& view, const Look& look_at) {
    const ReleasedLock released;
    std::unique_lock<std::mutex> held;
    if (view.session() != nullptr) held = taken(view.session()->busy());
    look_at(view.bone());
}

/// A copy of a channel: `copy(bone, slot, offset in the brick, count, out)` for each row, 0 if no bone is
/// stored.
template <typename Value, typename Copy>
py::array channel(const BoneView& view, const BoxArgument& argument, const Copy& copy) {
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

py::array fraction(const BoneView& view, const BoxArgument& box) {
    return channel<std::uint8_t>(
        view, box,
        [](const Bone& bone, std::int32_t slot, std::size_t offset, std::size_t count, std::uint8_t* out) {
            std::copy_n(bone.fractions(slot).data() + offset, count, out);
        });
}

py::array tissue(const BoneView& view, const BoxArgument& box) {
    return channel<std::uint8_t>(
        view, box,
        [](const Bone& bone, std::int32_t slot, std::size_t offset, std::size_t count, std::uint8_t* out) {
            if (const ByteBrick* labels = bone.content().tissues_of(slot))
                std::copy_n(labels->data() + offset, count, out);
        });
}

py::array stiffness(const BoneView& view, const BoxArgument& box) {
    return channel<float>(
        view, box,
        [](const Bone& bone, std::int32_t slot, std::size_t offset, std::size_t count, float* out) {
            for (std::size_t i = 0; i < count; ++i)
                out[i] = static_cast<float>(bone.content().stiffness_in(slot, offset + i));
        });
}

py::array hu(const BoneView& view, const BoxArgument& argument) {
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
    py::class_<BoneView>(module, "Bone",
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
            "spacing_mm", [](const BoneView& view) { return view.bone().grid().spacing_mm; },
            "Edge of a voxel, mm.")
        .def_property_readonly(
            "origin_mm", [](const BoneView& view) { return array_of(view.bone().grid().origin_mm); },
            "Centre of voxel (0, 0, 0), patient LPS, mm: (3,).")
        .def_property_readonly(
            "shape",
            [](const BoneView& view) {
                const glm::ivec3& n = view.bone().grid().size_voxels;
                return py::make_tuple(n.x, n.y, n.z);
            },
            "Voxels along i, j and k.")
        .def_property_readonly(
            "volume_mm3",
            [](const BoneView& view) {
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
            [](const BoneView& view) {
                std::uint64_t sum = 0;
                look(view, [&](const Bone& bone) { sum = checksum(bone); });
                return fmt::format("{:016x}", sum);
            },
            "Checksum of the remaining bone, 16 hex digits: equal for equal bones, and the `bone_checksum` "
            "of haptic_server "
            "--json.")
        .def("__repr__", [](const BoneView& view) {
            const Grid& grid = view.bone().grid();
            return fmt::format("<Bone of {} x {} x {} voxels of {:g} mm>", grid.size_voxels.x,
                               grid.size_voxels.y, grid.size_voxels.z, grid.spacing_mm);
        });
}

}  // namespace osteomill::python
