#include "studies/force/memory.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <utility>

#include "common/bone/bone_builder.h"
#include "common/scene/structure_watch.h"
#include "imaging/case/bone_source.h"
#include "imaging/import_bone.h"
#include "imaging/memory_estimate.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill::study {

namespace {

constexpr double voxel_mm = 0.1;

/// A part of the trial scan with bone in it, made by the importer and loaded as the server would.
MemoryRow weigh_head(const std::filesystem::path& scans, const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "skull.nrrd";
    std::ostringstream unheard;
    std::ifstream meminfo("/proc/meminfo");
    import_bone({.input = scans / "head_ct",
                 .output = file,
                 .spacing_mm = voxel_mm,
                 .threshold_hu = 300.0,
                 .region = parse_region("-60,10,730,-20,50,770")},
                {.messages = unheard, .available_memory_bytes = available_memory_bytes(meminfo)});
    Scene scene;
    scene.bone = FileSource{.path = file};
    MemoryRow row = weigh("CT of a skull (40 mm)", [&] { return load_bone(scene).bone; });
    std::filesystem::remove(file);
    return row;
}

/// Solid bone of `bone_mm` an edge in the low corner of a box of `box_mm`.
Bone cube_in_a_box(double bone_mm, double box_mm) {
    const auto edge = static_cast<int>(std::lround(box_mm / voxel_mm));
    const auto bone_bricks = static_cast<int>(std::lround(bone_mm / voxel_mm)) / brick_edge_voxels;
    const Grid grid{.size_voxels = glm::ivec3(edge), .spacing_mm = voxel_mm, .origin_mm = glm::dvec3(0.0)};
    BoneBuilder builder = BoneBuilder::homogeneous(grid, 1.0, false);
    ByteBrick full;
    full.fill(255);
    for (int z = 0; z < bone_bricks; ++z)
        for (int y = 0; y < bone_bricks; ++y)
            for (int x = 0; x < bone_bricks; ++x) builder.add_brick({x, y, z}, full, nullptr, nullptr);
    return std::move(builder).build();
}

/// A tube in the middle of the grid, from its low end.
StructureMask tube_along_x(const Grid& grid, double radius_mm, double length_mm) {
    const glm::ivec3 size = size_in_bricks(grid);
    const glm::dvec3 axis_mm = centre_of_voxel_mm(grid, grid.size_voxels / 2);
    std::vector<StructureBrick> bricks;
    for (BrickIndex brick = 0; brick < static_cast<BrickIndex>(size.x * size.y * size.z); ++brick) {
        StructureBrick part{brick, {}};
        for (std::size_t offset = 0; offset < brick_voxel_count; ++offset) {
            const glm::dvec3 place_mm = centre_of_voxel_mm(
                grid, brick_edge_voxels * brick_position(size, brick) + voxel_in_brick(offset));
            if (place_mm.x < length_mm &&
                std::hypot(place_mm.y - axis_mm.y, place_mm.z - axis_mm.z) <= radius_mm)
                part.voxels.set(offset);
        }
        bricks.push_back(part);
    }
    return {grid, std::move(bricks)};
}

MemoryRow weigh_watch(const std::string& name, std::vector<Structure> structures,
                      const std::vector<Tissue>& tissues, const std::vector<Burr>& burrs) {
    const Grid grid = structures.at(0).mask.grid();
    const glm::dvec3 edges_mm = glm::dvec3(grid.size_voxels) * grid.spacing_mm;
    MemoryRow row{.name = name, .bone_mm3 = 0.0, .box_mm3 = edges_mm.x * edges_mm.y * edges_mm.z};
    for (const Structure& structure : structures) row.bone_mm3 += structure.mask.volume_mm3();
    const auto before = std::chrono::steady_clock::now();
    const StructureWatch watch(std::move(structures), tissues, burrs);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - before;
    row.start_s = taken.count();
    row.mebibytes = static_cast<double>(watch.memory_bytes()) / (1024.0 * 1024.0);
    row.bytes_per_mm3 = static_cast<double>(watch.memory_bytes()) / row.bone_mm3;
    return row;
}

}  // namespace

MemoryRow weigh(const std::string& name, const std::function<Bone()>& make) {
    const auto before = std::chrono::steady_clock::now();
    const Bone bone = make();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - before;
    const Grid& grid = bone.grid();
    const glm::dvec3 edges_mm = glm::dvec3(grid.size_voxels) * grid.spacing_mm;
    MemoryRow row{.name = name,
                  .bone_mm3 = bone_volume_mm3(bone),
                  .box_mm3 = edges_mm.x * edges_mm.y * edges_mm.z,
                  .mebibytes = static_cast<double>(memory_bytes(bone)) / (1024.0 * 1024.0),
                  .start_s = taken.count()};
    row.bytes_per_mm3 = static_cast<double>(memory_bytes(bone)) / row.bone_mm3;
    return row;
}

std::vector<MemoryRow> weigh_scenes(const std::optional<std::filesystem::path>& scans,
                                    const std::filesystem::path& folder, const Progress& progress) {
    std::vector<MemoryRow> rows;
    const std::vector<std::string> phantoms = phantom_names();
    const double all = static_cast<double>(phantoms.size() + (scans ? 1 : 0));
    for (const std::string& name : phantoms) {
        rows.push_back(weigh(name + " phantom", [&] { return load_bone(phantom_scene(name)).bone; }));
        progress(static_cast<double>(rows.size()) / all);
    }
    if (scans) rows.push_back(weigh_head(*scans, folder));
    progress(1.0);
    return rows;
}

std::vector<MemoryRow> weigh_growing_bone() {
    std::vector<MemoryRow> rows;
    for (const double edge_mm : {3.2, 6.4, 12.8, 25.6, 51.2})
        rows.push_back(
            weigh(fmt::format("cube of {} mm", edge_mm), [&] { return cube_in_a_box(edge_mm, edge_mm); }));
    return rows;
}

std::vector<MemoryRow> weigh_growing_box() {
    std::vector<MemoryRow> rows;
    for (const double box_mm : {12.8, 25.6, 51.2, 102.4})
        rows.push_back(weigh(fmt::format("cube of 12.8 mm in {} mm", box_mm),
                             [&] { return cube_in_a_box(12.8, box_mm); }));
    return rows;
}

std::vector<MemoryRow> weigh_structures() {
    const Scene scene = phantom_scene("tooth");
    LoadedBone tooth = load_bone(scene);
    const Grid grid{.size_voxels = {352, 64, 64}, .spacing_mm = voxel_mm, .origin_mm = glm::dvec3(0.0)};
    const std::vector<Tissue> nerve{{.label = 1, .name = "nerve", .is_protected = true, .warn_mm = 1.0}};
    return {weigh_watch("pulp and nerve canal of the tooth phantom", std::move(tooth.structures),
                        scene.tissues, scene.burrs),
            weigh_watch("nerve, 1.5 mm across, 30 mm long", {{0, tube_along_x(grid, 0.75, 30.0)}}, nerve,
                        scene.burrs)};
}

std::string csv_of(const std::vector<MemoryRow>& rows) {
    std::string csv = "name,bone_mm3,box_mm3,mebibytes,bytes_per_mm3,start_s\n";
    for (const MemoryRow& r : rows)
        csv += fmt::format("{},{:.1f},{:.1f},{:.3f},{:.1f},{:.4f}\n", r.name, r.bone_mm3, r.box_mm3,
                           r.mebibytes, r.bytes_per_mm3, r.start_s);
    return csv;
}

}  // namespace osteomill::study
