#include "studies/force/memory.h"

#include <chrono>
#include <utility>

#include "common/scene/structure_watch.h"
#include "imaging/case/bone_source.h"
#include "imaging/phantoms/phantom.h"

namespace osteomill::study {

namespace {

MemoryRow row_of(const std::string& name, const Grid& grid, double bone_mm3, std::size_t bytes,
                 std::chrono::steady_clock::time_point began) {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began;
    const glm::dvec3 edges_mm = glm::dvec3(grid.size_voxels) * grid.spacing_mm;
    return {.name = name,
            .bone_mm3 = bone_mm3,
            .box_mm3 = edges_mm.x * edges_mm.y * edges_mm.z,
            .mebibytes = static_cast<double>(bytes) / (1024.0 * 1024.0),
            .bytes_per_mm3 = static_cast<double>(bytes) / bone_mm3,
            .start_s = taken.count()};
}

}  // namespace

MemoryRow weigh_scene(const std::string& phantom) {
    const auto began = std::chrono::steady_clock::now();
    const Bone bone = load_bone(phantom_scene(phantom)).bone;
    return row_of(phantom + " phantom", bone.grid(), bone_volume_mm3(bone), memory_bytes(bone), began);
}

MemoryRow weigh_structures() {
    const Scene scene = phantom_scene("tooth");
    std::vector<Structure> structures = load_bone(scene).structures;
    const Grid grid = structures.at(0).mask.grid();
    double volume_mm3 = 0.0;
    for (const Structure& structure : structures) volume_mm3 += structure.mask.volume_mm3();
    const auto began = std::chrono::steady_clock::now();
    const StructureWatch watch(std::move(structures), scene.tissues, scene.burrs);
    return row_of("pulp and nerve canal of the tooth phantom", grid, volume_mm3, watch.memory_bytes(), began);
}

Table table_of(const std::vector<MemoryRow>& rows) {
    Table table({"name", "bone_mm3", "box_mm3", "mebibytes", "bytes_per_mm3", "start_s"});
    for (const MemoryRow& r : rows)
        table.add({r.name, r.bone_mm3, r.box_mm3, r.mebibytes, r.bytes_per_mm3, r.start_s});
    return table;
}

}  // namespace osteomill::study
