#include "haptic_server/imaging/import_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>

#include "haptic_server/imaging/hu_file.h"
#include "haptic_server/imaging/image_part.h"
#include "haptic_server/imaging/image_reader.h"
#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/memory_estimate.h"
#include "haptic_server/imaging/near_bone.h"
#include "haptic_server/imaging/progress.h"
#include "haptic_server/imaging/refine.h"

namespace osteomill {

namespace {

double gibibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(1u << 30);
}

/// What is to be done, known before any voxel is read.
struct ImportPlan {
    Grid grid;
    VoxelBox needed;
};

ImportPlan plan(const ImportOptions& options, const SourceImage& image, std::ostream& messages) {
    const Region extent = extent_of(image);
    Region region = extent;
    try {
        if (options.region) {
            region = clip(*options.region, extent);
            if (region != *options.region)
                messages << fmt::format("--region clipped to {} (mm, patient LPS): the image ends there\n",
                                        to_text(region));
        }
        // Refining draws on the voxels around; smoothing for a coarser grid reaches as far as its voxels.
        const double finest_mm = std::min({image.spacing_mm.x, image.spacing_mm.y, image.spacing_mm.z});
        const int margin =
            refine_margin_voxels + static_cast<int>(std::min(2.0 * options.spacing_mm / finest_mm, 1e6));
        return {.grid = grid_over(region, options.spacing_mm), .needed = voxels_for(image, region, margin)};
    } catch (const std::invalid_argument& error) {
        throw ImagingError(options.input, error.what());
    }
}

void require_memory(const ImportOptions& options, const SourceImage& image, const ImportPlan& work,
                    const ImportSurroundings& surroundings) {
    const std::uint64_t needed = import_memory_bytes(voxel_count(image), voxel_count(work.needed), work.grid);
    const glm::ivec3 from = image.size_voxels;
    const glm::ivec3 to = work.grid.size_voxels;
    surroundings.messages << fmt::format(
        "{}: {} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm become {} x {} x {} of {:.4g} mm; about "
        "{:.2f} GiB of "
        "memory\n",
        options.input.string(), from.x, from.y, from.z, image.spacing_mm.x, image.spacing_mm.y,
        image.spacing_mm.z, to.x, to.y, to.z, work.grid.spacing_mm, gibibytes(needed));
    if (surroundings.available_memory_bytes && needed > *surroundings.available_memory_bytes)
        throw ImagingError(
            options.input,
            fmt::format("needs about {:.1f} GiB of memory and {:.1f} GiB are available; take a smaller "
                        "--region (the image covers {}) or a larger --spacing-mm",
                        gibibytes(needed), gibibytes(*surroundings.available_memory_bytes),
                        to_text(extent_of(image))));
}

void make_hu(const ImportOptions& options, SourceImage& image, std::ostream& messages) {
    if (const std::size_t replaced = replace_not_finite(image.values); replaced > 0)
        messages << fmt::format("{}: {} voxels are not numbers; taken as air\n", options.input.string(),
                                replaced);
    if (const auto* rescale = std::get_if<Rescale>(&options.to_hu)) rescale_values(*rescale, image.values);
    if (const auto* window = std::get_if<IntensityWindow>(&options.to_hu))
        window_values(*window, image.values);
}

/// The region's part in HU. The rest of the scan is let go.
SourceImage read_part(const ImportOptions& options, OpenedImage opened, const VoxelBox& needed,
                      const ImportSurroundings& surroundings) {
    ProgressLine progress(surroundings.messages, surroundings.is_terminal, "reading");
    SourceImage image = std::move(opened.image);
    image.values = opened.read_values(progress.reporter());
    make_hu(options, image, surroundings.messages);
    return cut(image, needed);
}

void keep_bone(const ImportOptions& options, HuVolume& volume,
               std::map<std::string, std::string>& key_values) {
    if (!options.threshold_hu) return;
    const std::int16_t highest = *std::max_element(volume.hu.begin(), volume.hu.end());
    if (clear_far_from_bone(volume, *options.threshold_hu) == 0)
        throw ImagingError(options.input,
                           fmt::format("no voxel reaches --threshold-hu {}; the highest has {} HU",
                                       *options.threshold_hu, highest));
    key_values[threshold_key] = threshold_text(*options.threshold_hu);
}

}  // namespace

void import_bone(const ImportOptions& options, const ImportSurroundings& surroundings) {
    try {
        OpenedImage opened = open_image(options.input, options.series_uid);
        for (const std::string& note : opened.image.notes) surroundings.messages << note << '\n';
        const ImportPlan work = plan(options, opened.image, surroundings.messages);
        require_memory(options, opened.image, work, surroundings);
        SourceImage part = read_part(options, std::move(opened), work.needed, surroundings);
        HuVolume volume;
        {
            ProgressLine progress(surroundings.messages, surroundings.is_terminal, "refining");
            volume = refine(std::move(part), work.grid, progress.reporter());
        }
        std::map<std::string, std::string> key_values;
        keep_bone(options, volume, key_values);
        surroundings.messages << fmt::format("writing {}\n", options.output.string()) << std::flush;
        write_hu_nrrd(options.output, volume, key_values);
    } catch (const std::bad_alloc&) {
        throw ImagingError(options.input,
                           "does not fit in memory; take a smaller --region or a larger --spacing-mm");
    }
}

}  // namespace osteomill
