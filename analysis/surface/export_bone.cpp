#include "analysis/surface/export_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/surface/mesh_file.h"
#include "analysis/surface/surface_mesh.h"
#include "common/files/distinct_files.h"
#include "common/program/command_options.h"
#include "imaging/bone_file/bone_of_file.h"
#include "imaging/bone_file/removed_bone.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// The share of an export that is done before each of its parts, by their durations for a large bone.
constexpr double done_before_surface = 0.4;
constexpr double done_before_writing = 0.8;

BoneOfFile read(const std::filesystem::path& path, std::optional<double> threshold_hu) {
    return bone_of_file(path, threshold_hu, default_stiffness_relation());
}

/// Such a bone is no remainder of the original, and a difference would be meaningless.
void require_carved_from(const ExportOptions& options, const Bone& before, const Bone& after) {
    const Grid& from = before.grid();
    const Grid& to = after.grid();
    if (from != to)
        throw ImagingError(
            options.bone, fmt::format("lies on another grid than {}: {} x {} x {} voxels of {} mm, not {} x "
                                      "{} x {} of {} mm from the same origin",
                                      options.original->string(), to.size_voxels.x, to.size_voxels.y,
                                      to.size_voxels.z, to.spacing_mm, from.size_voxels.x, from.size_voxels.y,
                                      from.size_voxels.z, from.spacing_mm));
    if (const auto voxel = first_risen_voxel(before, after)) {
        const glm::dvec3 place_mm = centre_of_voxel_mm(to, *voxel);
        throw ImagingError(
            options.bone,
            fmt::format("has bone at ({:.2f}, {:.2f}, {:.2f}) mm where {} has less: it was not carved from "
                        "it, or with another --threshold-hu",
                        place_mm.x, place_mm.y, place_mm.z, options.original->string()));
    }
}

void export_removed(const ExportOptions& options, const BoneOfFile& carved,
                    const std::function<void(const std::string&)>& say, const ReportProgress& progress) {
    // The original is built with the threshold of the carved bone.
    const BoneOfFile original =
        read(*options.original, options.threshold_hu ? options.threshold_hu : carved.threshold_hu);
    require_carved_from(options, original.bone, carved.bone);
    progress(done_before_writing);
    save_removed(options.output, original.bone, carved.bone);
    say(fmt::format("{}: {:.3f} mm^3 removed", options.output.string(),
                    bone_volume_mm3(original.bone) - bone_volume_mm3(carved.bone)));
}

void export_surface(const ExportOptions& options, const Bone& bone,
                    const std::function<void(const std::string&)>& say, const ReportProgress& progress) {
    const double spacing_mm = bone.grid().spacing_mm;
    const double cells = options.cell_mm.value_or(spacing_mm) / spacing_mm;
    const SurfaceMesh mesh = surface_of(bone, std::max(1, static_cast<int>(std::lround(cells))));
    if (mesh.triangles.empty())
        throw ImagingError(options.bone, "has no surface: no voxel is more than half full");
    progress(done_before_writing);
    write_mesh(options.output, mesh);
    say(fmt::format("{}: {} triangles, mm in patient LPS", options.output.string(), mesh.triangles.size()));
}

}  // namespace

ParseResult<ExportOptions> parse_export_command_line(int argc, const char* const* argv,
                                                     const std::string& version) {
    ExportOptions options;
    CommandOptions app(
        "Writes the surface of a bone, carved or not, for other programs; or what was removed of it.",
        "bone_export", fmt::format("bone_export {}", version));
    app.add_option("BONE.nrrd", options.bone, "A bone file of bone_import or haptic_server --save-bone")
        .required();
    app.add_option("OUT", options.output,
                   "OUT.stl, OUT.ply or OUT.obj: the surface, closed, in mm of patient LPS; with --removed "
                   "OUT.nrrd")
        .required();
    app.add_option("--removed", options.original,
                   "The bone file that BONE.nrrd was carved from: write what is gone of each voxel, 0 to 255")
        .type_name("ORIGINAL.nrrd");
    app.add_option("--threshold-hu", options.threshold_hu,
                   "Bone is at and above this (default: as the file says, else 300)")
        .check(within(-1024.0, 10000.0));
    app.add_option("--spacing-mm", options.cell_mm,
                   "Coarser triangles, of cells about so long: for printing (default: a voxel)")
        .check(within(0.01, 10.0));
    if (auto text = app.parse_or_text(argc, argv)) return {std::nullopt, *std::move(text)};
    if (options.cell_mm && options.original)
        throw std::invalid_argument("--spacing-mm: of a surface; what was removed has the bone's own");
    if (options.original && options.output.extension() != ".nrrd")
        throw std::invalid_argument(fmt::format(
            "OUT '{}': what was removed is an image, its name ends in .nrrd", options.output.string()));
    if (!options.original && !is_mesh_name(options.output))
        throw std::invalid_argument(
            fmt::format("OUT '{}': a surface's name ends in {}; for what was removed "
                        "give --removed ORIGINAL.nrrd",
                        options.output.string(), mesh_endings));
    std::vector<NamedFile> files{{"BONE.nrrd", options.bone, false}, {"OUT", options.output}};
    if (options.original) files.push_back({"--removed", *options.original, false});
    require_distinct(files);
    return {options, {}};
}

void export_bone(const ExportOptions& options, const std::function<void(const std::string&)>& say,
                 const ReportProgress& progress) {
    progress(0.0);
    const BoneOfFile read_bone = read(options.bone, options.threshold_hu);
    if (!read_bone.doubt.empty()) say(fmt::format("{}: warning: {}", options.bone.string(), read_bone.doubt));
    progress(done_before_surface);
    if (options.original)
        export_removed(options, read_bone, say, progress);
    else
        export_surface(options, read_bone.bone, say, progress);
}

}  // namespace osteomill
