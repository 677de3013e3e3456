#include "imaging/import_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <map>
#include <ostream>
#include <span>
#include <stdexcept>
#include <vector>

#include "common/bone/grid.h"
#include "common/program/progress.h"
#include "common/text/foreign_text.h"
#include "imaging/bone_file/hu_file.h"
#include "imaging/formats/image_reader.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"
#include "imaging/in_parallel.h"
#include "imaging/memory_estimate.h"
#include "imaging/resampling/field_of_view.h"
#include "imaging/resampling/hu_histogram.h"
#include "imaging/resampling/near_bone.h"
#include "imaging/resampling/refine.h"
#include "imaging/resampling/region.h"
#include "imaging/resampling/scratch_values.h"
#include "imaging/resampling/slice_shapes.h"
#include "imaging/resampling/specks.h"

namespace osteomill {

namespace {

double gibibytes(std::uint64_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(1u << 30);
}

/// The plan of an import, known before any voxel is read.
struct ImportPlan {
    Grid grid;
    ImageBox needed;
    std::optional<int>
        axis_of_shapes{};  ///< the part's axis along which contours are followed from slice to slice
};

/// A bone may have as few voxels as a scan.
void require_plausible_size(const Grid& grid) {
    const std::array<std::uint64_t, 3> sizes{static_cast<std::uint64_t>(grid.size_voxels.x),
                                             static_cast<std::uint64_t>(grid.size_voxels.y),
                                             static_cast<std::uint64_t>(grid.size_voxels.z)};
    try {
        plausible_voxel_count(sizes);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format(
            "would become {} x {} x {} voxels: {}; take a smaller --region or a larger --spacing-mm",
            sizes[0], sizes[1], sizes[2], error.what()));
    }
}

/// Without a threshold there is no contour to follow.
std::optional<int> followed_axis(const ImportOptions& options, const glm::dvec3& spacing_mm) {
    return options.threshold_hu && options.follows_contours ? axis_of_far_slices(spacing_mm) : std::nullopt;
}

/// Refining draws on the voxels around; smoothing for a coarser grid reaches as far as its voxels, a contour
/// that is followed from slice to slice as far as it is looked for.
glm::ivec3 margin_voxels(const ImportOptions& options, const SourceImage& image, double spacing_mm) {
    const double finest_mm = std::min({image.spacing_mm.x, image.spacing_mm.y, image.spacing_mm.z});
    glm::ivec3 margin(refine_margin_voxels + static_cast<int>(std::min(2.0 * spacing_mm / finest_mm, 1e6)));
    const std::optional<int> axis = followed_axis(options, image.spacing_mm);
    for (int other = 0; axis && other < 3; ++other)
        if (other != *axis)
            margin[other] =
                std::max(margin[other],
                         static_cast<int>(std::min(
                             contour_reach_mm(image.spacing_mm, *axis) / image.spacing_mm[other], 1e6)) +
                             1);
    return margin;
}

double spacing_for(const ScanRegion& region, const ImportOptions& options,
                   const ImportSurroundings& surroundings) {
    if (!options.may_be_coarser) return options.spacing_mm;
    // Not by the memory that is free: the same command makes the same bone on each machine.
    const double spacing_mm = usual_spacing_mm(region.high_mm - region.low_mm, options.spacing_mm, 0);
    if (spacing_mm > options.spacing_mm)
        surroundings.messages << fmt::format(
            "{}: the region is large to drill: voxels of {:.2f} mm instead of {:.2f}; take a smaller "
            "--region, or choose --spacing-mm\n",
            options.input.string(), spacing_mm, options.spacing_mm);
    return spacing_mm;
}

ImportPlan plan(const ImportOptions& options, const SourceImage& image,
                const ImportSurroundings& surroundings) {
    const ScanRegion extent = extent_of(image);
    ScanRegion region = extent;
    return said_of(options.input, [&]() -> ImportPlan {
        if (options.region) {
            region = clip(*options.region, extent);
            if (region != *options.region)
                surroundings.messages << fmt::format(
                    "--region clipped to {} (mm, patient LPS): the image ends there\n", to_text(region));
        }
        const Grid grid = grid_over(region, spacing_for(region, options, surroundings));
        require_plausible_size(grid);
        const ImageBox needed = voxels_for(image, region, margin_voxels(options, image, grid.spacing_mm));
        return {.grid = grid,
                .needed = needed,
                .axis_of_shapes = followed_axis(options, part_of(image, needed).spacing_mm)};
    });
}

/// A bit a voxel: was it measured?
std::uint64_t floats_of_field(const ImportPlan& work) {
    return voxel_count(work.needed) / 32 + 1;
}

/// Values of the region, which of them were measured, and the known shapes in its slices.
std::uint64_t scratch_floats(const ImportPlan& work) {
    return voxel_count(work.needed) * (work.axis_of_shapes ? 1 + SliceShapes::floats_per_voxel : 1) +
           floats_of_field(work);
}

void require_memory(const ImportOptions& options, const OpenedImage& opened, const ImportPlan& work,
                    const ImportSurroundings& surroundings) {
    const SourceImage& image = opened.image;
    const std::uint64_t needed = import_memory_bytes(opened.reading_bytes, scratch_floats(work), work.grid);
    if (needed > most_import_bytes && opened.reading_bytes > most_import_bytes / 3)
        throw ImagingError(options.input,
                           fmt::format("has pixels of which {:.1f} GiB would be held at once, more than an "
                                       "import may take; save the scan as one file a slice, or as NRRD",
                                       gibibytes(opened.reading_bytes)));
    if (needed > most_import_bytes)
        throw ImagingError(options.input,
                           fmt::format("needs about {:.1f} GiB of memory, where an import may take {:.1f}; "
                                       "take a smaller --region or a larger --spacing-mm",
                                       gibibytes(needed), gibibytes(most_import_bytes)));
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

/// How many are none, since they were not measured.
std::size_t make_hu(const ImportOptions& options, std::span<float> values) {
    const std::size_t not_measured = mark_not_finite(values);
    if (const auto* rescale = std::get_if<Rescale>(&options.to_hu)) rescale_values(*rescale, values);
    if (const auto* window = std::get_if<IntensityWindow>(&options.to_hu)) window_values(*window, values);
    return not_measured;
}

ImagingError no_bone(const ImportOptions& options, int highest_hu) {
    return {options.input, fmt::format("no voxel reaches --threshold-hu {}; the highest has {} HU",
                                       *options.threshold_hu, highest_hu)};
}

/// Reads the region's part in HU; a slice at most is held of the rest of the scan. Returns whether all of the
/// scan was measured; values that were not are not a number.
bool read_part(const ImportOptions& options, const OpenedImage& opened, const ImageBox& needed,
               std::span<float> values, const std::function<void()>& pause,
               const ImportSurroundings& surroundings) {
    std::size_t not_measured = 0;
    HuHistogram histogram;
    {
        ProgressLine progress(surroundings.messages, surroundings.is_terminal, "reading");
        opened.read_slices(
            [&](int k, std::span<float> slice) {
                not_measured += make_hu(options, slice);
                histogram.add(slice);
                put_slice(opened.image, needed, k, slice, values);
                pause();
            },
            progress.reporter());
    }
    if (const std::optional<float> fill = histogram.fill_hu()) {
        surroundings.messages << fmt::format(
            "{}: {} HU fill what lies outside its field of view; taken as not measured\n",
            options.input.string(), *fill);
        const auto slices = static_cast<std::size_t>(part_of(opened.image, needed).size_voxels.z);
        for (std::size_t k = 0; k < slices; ++k) {
            std::ranges::replace(values.subspan(k * (values.size() / slices), values.size() / slices), *fill,
                                 std::numeric_limits<float>::quiet_NaN());
            pause();
        }
    }
    // Values that a window made must not count as HU of a scan.
    const bool is_windowed = std::holds_alternative<IntensityWindow>(options.to_hu);
    const std::string doubt = is_windowed ? std::string() : histogram.doubt();
    if (!doubt.empty())
        surroundings.messages << fmt::format("{}: warning: {}\n", options.input.string(), doubt);
    // Checked before the long part: if no voxel of the scan reaches the threshold, a voxel of the result can
    // reach it only by overshoot.
    if (options.threshold_hu && histogram.highest_hu() < *options.threshold_hu)
        throw no_bone(options, histogram.highest_hu());
    return not_measured == 0 && !histogram.fill_hu();
}

/// Slices of the result that are at work, by their number.
class SliceRing {
  public:
    SliceRing(const Grid& grid, int held)
        : slice_(static_cast<std::size_t>(voxels_of_slice(grid))),
          held_(static_cast<std::size_t>(held)),
          hu_(slice_ * held_) {}
    std::span<std::int16_t> slice(int z) {
        return std::span(hu_).subspan(slice_ * (static_cast<std::size_t>(z) % held_), slice_);
    }

  private:
    std::size_t slice_;
    std::size_t held_;
    std::vector<std::int16_t> hu_;
};

/// Makes the slices of the result.
struct SliceSource {
    const Refiner& refiner;
    const FieldOfView* field;
    const Grid& grid;

    void fill(int z, std::span<std::int16_t> hu) const {
        refiner.slice(z, hu);
        if (field != nullptr) field->clear_outside(grid, z, hu);
    }
};

std::string specks_in_words(const Specks& specks, const Grid& grid) {
    return fmt::format("{} {} of bone of less than {:g} mm3, {:.2g} mm3 in all, touch{} nothing else",
                       specks.count, specks.count == 1 ? "part" : "parts", speck_mm3,
                       static_cast<double>(specks.voxels) * voxel_volume_mm3(grid),
                       specks.count == 1 ? "es" : "");
}

/// Looks through the whole result beforehand: a part may touch the rest in the last slice.
Specks find_specks(const ImportOptions& options, const SliceSource& source,
                   const std::function<void()>& pause, const ReportProgress& report) {
    const int slices = source.grid.size_voxels.z;
    const int at_once = slices_at_once(source.grid);
    SliceRing ring(source.grid, at_once);
    SpeckSearch search(source.grid, *options.threshold_hu);
    for (int first = 0; first < slices; first += at_once) {
        const int now = std::min(at_once, slices - first);
        in_parallel(now, [&](int i) { source.fill(first + i, ring.slice(first + i)); });
        pause();
        for (int i = 0; i < now; ++i) search.add(ring.slice(first + i));
        report(static_cast<double>(first + now) / slices);
    }
    if (search.has_given_up())
        throw ImagingError(options.input,
                           fmt::format("bone at --threshold-hu {} falls into over a million parts, which is "
                                       "noise; take a higher one, or go without --leave-out-specks",
                                       *options.threshold_hu));
    return search.found();
}

void say_specks(const ImportOptions& options, const SpeckSearch& search, const Grid& grid,
                std::ostream& messages) {
    if (search.has_given_up()) {
        messages << fmt::format(
            "{}: warning: bone falls into over a million parts; the threshold may be too low\n",
            options.input.string());
        return;
    }
    const Specks specks = search.found();
    if (specks.count > 0)
        messages << fmt::format("{}: {}; --leave-out-specks leaves {} out\n", options.input.string(),
                                specks_in_words(specks, grid), specks.count == 1 ? "it" : "them");
}

/// Refines, clears voxels far from bone if there is a threshold and soft tissue is not kept, writes: a few
/// slices at a time, on all cores. `search`, where there is one, sees every slice. Returns how many voxels
/// are bone; 0 without a threshold.
std::uint64_t write_refined(const ImportOptions& options, const SliceSource& source, const Specks& left_out,
                            SpeckSearch* search, const std::function<void()>& pause, BoneFileWriter& writer,
                            const ReportProgress& report) {
    const Grid& grid = source.grid;
    const int slices = grid.size_voxels.z;
    const int at_once = slices_at_once(grid);
    const bool clears = options.threshold_hu && !options.keeps_soft_tissue;
    const int reach = clears ? kept_voxels_around_bone : 0;
    const int held = at_once + 2 * reach;
    SliceRing ring(grid, held);
    std::optional<NearBone> near;
    if (options.threshold_hu) near.emplace(grid, *options.threshold_hu, held);
    std::atomic<int> highest{std::numeric_limits<std::int16_t>::min()};
    const auto note_highest = [&](std::span<const std::int16_t> hu) {
        const int here = *std::max_element(hu.begin(), hu.end());
        int before = highest;
        while (here > before && !highest.compare_exchange_weak(before, here)) continue;
    };
    int written = 0;
    for (int refined = 0; refined < slices;) {
        const int now = std::min(at_once, slices - refined);
        in_parallel(now, [&](int i) {
            const std::span<std::int16_t> hu = ring.slice(refined + i);
            source.fill(refined + i, hu);
            note_highest(hu);
            clear_specks(left_out, refined + i, grid.size_voxels.x, hu);
            if (near) near->look_at(refined + i, hu);
        });
        pause();
        refined += now;
        // The last ones wait for the slices above them.
        const int ready = (refined == slices ? slices : refined - reach) - written;
        if (clears) in_parallel(ready, [&](int i) { near->clear_far(written + i, ring.slice(written + i)); });
        for (const int end = written + std::max(ready, 0); written < end; ++written) {
            writer.add(ring.slice(written));
            if (search != nullptr) search->add(ring.slice(written));
        }
        report(static_cast<double>(written) / slices);
    }
    if (near && near->bone_voxels() == 0) throw no_bone(options, highest);
    return near ? near->bone_voxels() : 0;
}

/// A result of nothing but bone comes from a threshold that is far too low.
void say_if_all_is_bone(const ImportOptions& options, const Grid& grid, std::uint64_t bone_voxels,
                        std::ostream& messages) {
    if (bone_voxels < voxel_count(grid)) return;
    messages << fmt::format("{}: warning: every voxel reaches --threshold-hu {}, so that all of it is bone\n",
                            options.input.string(), *options.threshold_hu);
}

/// Scratch data go into the folder of the output file, which has space for large files.
std::filesystem::path scratch_folder(const ImportOptions& options) {
    return options.output.has_parent_path() ? options.output.parent_path() : std::filesystem::path(".");
}

}  // namespace

void import_bone(const ImportOptions& options, const ImportSurroundings& surroundings) {
    import_bone(options, open_image(options.input, options.choice), surroundings);
}

void import_bone(const ImportOptions& options, const OpenedImage& opened,
                 const ImportSurroundings& surroundings) {
    try {
        for (const std::string& note : opened.image.notes) surroundings.messages << printable(note) << '\n';
        const ImportPlan work = plan(options, opened.image, surroundings);
        require_memory(options, opened, work, surroundings);
        std::map<std::string, std::string> key_values;
        if (options.threshold_hu) key_values[threshold_key] = threshold_text(*options.threshold_hu);
        const ScratchValues scratch(scratch_floats(work), most_scan_bytes, scratch_folder(options));
        const auto pause = [&] {
            surroundings.go_on();
            scratch.let_go();
        };
        const std::span<float> values = scratch.values().first(voxel_count(work.needed));
        const bool is_whole = read_part(options, opened, work.needed, values, pause, surroundings);
        const SourceImage part = part_of(opened.image, work.needed);
        const std::span<float> space = scratch.values().subspan(values.size());
        std::optional<FieldOfView> field;
        if (!is_whole)
            field.emplace(part, values, std::as_writable_bytes(space.first(floats_of_field(work))), pause);
        if (field && field->voxels_outside() > 0)
            surroundings.messages << fmt::format("{}: {} voxels were not measured (padding); taken as air\n",
                                                 options.input.string(), field->voxels_outside());
        std::optional<SliceShapes> shapes;
        if (work.axis_of_shapes)
            shapes.emplace(part, values, *work.axis_of_shapes, *options.threshold_hu, work.grid.spacing_mm,
                           space.subspan(floats_of_field(work)), pause);
        const Refiner refiner(part, values, work.grid, shapes ? &*shapes : nullptr, pause);
        const SliceSource source{refiner, field ? &*field : nullptr, work.grid};
        Specks left_out;
        if (options.leaves_out_specks && options.threshold_hu) {
            ProgressLine progress(surroundings.messages, surroundings.is_terminal, "looking for specks");
            left_out = find_specks(options, source, pause, progress.reporter());
            surroundings.messages << fmt::format("{}: {}\n", options.input.string(),
                                                 left_out.count == 0
                                                     ? "no specks to leave out"
                                                     : specks_in_words(left_out, work.grid) + "; left out");
        }
        std::optional<SpeckSearch> search;
        if (options.threshold_hu && !options.leaves_out_specks)
            search.emplace(work.grid, *options.threshold_hu);
        ProgressLine progress(surroundings.messages, surroundings.is_terminal, "refining");
        BoneFileWriter writer(options.output, work.grid, std::move(key_values));
        const std::uint64_t bone_voxels = write_refined(
            options, source, left_out, search ? &*search : nullptr, pause, writer, progress.reporter());
        if (search) say_specks(options, *search, work.grid, surroundings.messages);
        say_if_all_is_bone(options, work.grid, bone_voxels, surroundings.messages);
        writer.commit();
    } catch (const std::bad_alloc&) {
        throw ImagingError(options.input,
                           "does not fit in memory; take a smaller --region or a larger --spacing-mm");
    }
}

}  // namespace osteomill
