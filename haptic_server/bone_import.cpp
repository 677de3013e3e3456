// bone_import: CT in, bone out. Thin: options, then read, refine, write.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <sstream>

#include "haptic_server/imaging/dicom_series.h"
#include "haptic_server/imaging/hu_file.h"
#include "haptic_server/imaging/image_file.h"
#include "haptic_server/imaging/imaging_error.h"
#include "haptic_server/imaging/intensity.h"
#include "haptic_server/imaging/refine.h"

namespace {

using namespace osteomill;

struct Options {
    std::string input;
    std::string output;
    double spacing_mm = 0.1;
    std::optional<double> threshold_hu;
    std::vector<double> region_mm;
    std::vector<double> rescale;
    std::vector<double> intensity_window;
    std::string series_uid;
};

class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

Options parse(CLI::App& app, int argc, char** argv) {
    Options options;
    app.add_option("input", options.input, "DICOM folder, or a file: NRRD, NIfTI, MHA, MHD")->required();
    app.add_option("output", options.output, "bone to write, ending in .nrrd")->required();
    app.add_option("--spacing-mm", options.spacing_mm, "edge of a voxel")
        ->check(CLI::Range(0.01, 10.0))
        ->capture_default_str();
    app.add_option("--threshold-hu", options.threshold_hu,
                   "bone is at and above this; what lies far from bone becomes air")
        ->check(CLI::Range(-1024.0, 30000.0));
    app.add_option("--region", options.region_mm,
                   "x0,y0,z0,x1,y1,z1 in patient LPS, mm: import this box only")
        ->delimiter(',')
        ->expected(6);
    app.add_option("--rescale", options.rescale,
                   "SLOPE,INTERCEPT from stored values to HU, for files that carry none")
        ->delimiter(',')
        ->expected(2);
    app.add_option("--intensity-window", options.intensity_window,
                   "LOW,HIGH of data without HU (MRI, 8-bit scans): LOW becomes 0 HU, HIGH 2000 HU")
        ->delimiter(',')
        ->expected(2);
    app.add_option("--series", options.series_uid, "UID of the DICOM series to take; default: the largest");
    app.set_version_flag("--version", OSTEOMILL_VERSION);
    app.parse(argc, argv);

    const auto finite = [](const std::vector<double>& v) {
        return std::all_of(v.begin(), v.end(), [](double x) { return std::isfinite(x); });
    };
    if (!options.output.ends_with(".nrrd"))
        throw UsageError("output must end in .nrrd, not be " + options.output);
    if (!options.rescale.empty() && !options.intensity_window.empty())
        throw UsageError("give --rescale or --intensity-window, not both");
    if (!finite(options.rescale) || (!options.rescale.empty() && options.rescale[0] == 0.0))
        throw UsageError("--rescale needs a finite slope other than 0 and a finite intercept");
    if (!finite(options.intensity_window) ||
        (!options.intensity_window.empty() && !(options.intensity_window[0] < options.intensity_window[1])))
        throw UsageError("--intensity-window needs LOW below HIGH");
    if (!finite(options.region_mm)) throw UsageError("--region needs six finite numbers");
    for (std::size_t axis = 0; axis < options.region_mm.size() / 2; ++axis)
        if (!(options.region_mm[axis] < options.region_mm[axis + 3]))
            throw UsageError("--region needs x0,y0,z0 below x1,y1,z1");
    return options;
}

ScanImage::Pointer read_folder(const Options& options, const Progress& progress) {
    const std::vector<DicomSeries> all = list_series(options.input);
    const DicomSeries* chosen = &all.front();
    if (!options.series_uid.empty()) {
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const DicomSeries& s) { return s.uid == options.series_uid; });
        if (found == all.end())
            throw ImagingError(fmt::format("{}: no series {}; run without --series to see what there is",
                                           options.input, options.series_uid));
        chosen = &*found;
    }
    std::cerr << fmt::format("series {} ({} slices{}{})\n", chosen->uid, chosen->files.size(),
                             chosen->description.empty() ? "" : ", ", chosen->description);
    for (const DicomSeries& other : all)
        if (&other != chosen)
            std::cerr << fmt::format("  also here: --series {} ({} slices{}{})\n", other.uid,
                                     other.files.size(), other.description.empty() ? "" : ", ",
                                     other.description);
    return read_series(*chosen, progress);
}

ScanImage::Pointer read_input(const Options& options, const Progress& progress) {
    if (std::filesystem::is_directory(options.input)) return read_folder(options, progress);
    ScanFile file = read_image_file(options.input);
    if (!file.has_orientation)
        std::cerr << fmt::format("{}: states no orientation; taken as LPS, axis-aligned\n", options.input);
    return file.image;
}

double available_memory_bytes() {
    std::ifstream file("/proc/meminfo");
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string name;
        double kilobytes = 0.0;
        if (words >> name >> kilobytes && name == "MemAvailable:") return kilobytes * 1024.0;
    }
    return HUGE_VAL;
}

std::string text_of(const Region& region) {
    return fmt::format("{:.1f},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f}", region.low_mm.x, region.low_mm.y,
                       region.low_mm.z, region.high_mm.x, region.high_mm.y, region.high_mm.z);
}

Region wanted_region(const Options& options, const ScanImage& scan) {
    const Region extent = extent_of(scan);
    if (options.region_mm.empty()) return extent;
    const std::vector<double>& r = options.region_mm;
    const Region asked{{r[0], r[1], r[2]}, {r[3], r[4], r[5]}};
    const std::optional<Region> shared = intersection(asked, extent);
    if (!shared)
        throw ImagingError(fmt::format("{}: --region lies outside the scan, which spans {} mm (LPS)",
                                       options.input, text_of(extent)));
    if (shared->low_mm != asked.low_mm || shared->high_mm != asked.high_mm)
        std::cerr << fmt::format("--region reaches past the scan; clipped to {}\n", text_of(*shared));
    return *shared;
}

void run(const Options& options) {
    const bool on_terminal = isatty(STDERR_FILENO) != 0;
    const ScanImage::Pointer scan = read_input(options, progress_on(std::cerr, on_terminal, "reading"));
    if (!options.rescale.empty()) rescale(*scan, options.rescale[0], options.rescale[1]);
    if (!options.intensity_window.empty())
        map_intensity_window(*scan, options.intensity_window[0], options.intensity_window[1]);

    const Region region = wanted_region(options, *scan);
    const double needed = refine_memory_bytes(*scan, region, options.spacing_mm);
    const glm::dvec3 cells = (region.high_mm - region.low_mm) / options.spacing_mm + 1.0;
    std::cerr << fmt::format("{:.0f} x {:.0f} x {:.0f} voxels of {} mm, about {:.0f} MiB\n",
                             std::floor(cells.x), std::floor(cells.y), std::floor(cells.z),
                             options.spacing_mm, needed / 1048576.0);
    if (needed > available_memory_bytes())
        throw ImagingError(
            fmt::format("{}: needs {:.1f} GiB and {:.1f} GiB are free; choose a smaller --region or a larger "
                        "--spacing-mm",
                        options.input, needed / 1073741824.0, available_memory_bytes() / 1073741824.0));

    HuVolume volume =
        refine(*scan, grid_of(region, options.spacing_mm), progress_on(std::cerr, on_terminal, "refining"));
    HeaderKeys keys;
    if (options.threshold_hu) {
        clear_far_from_bone(volume, *options.threshold_hu);
        keys[threshold_key] = fmt::format("{}", *options.threshold_hu);
    }
    write_hu_file(options.output, volume, keys);
    std::cerr << fmt::format("wrote {}\n", options.output);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app(
        "Turns a CT scan into a bone for haptic_server: isotropic, axis-aligned in patient LPS, in HU.",
        "bone_import");
    try {
        run(parse(app, argc, argv));
        return 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "bone_import: " << error.what() << "; see --help\n";
        return 2;
    } catch (const UsageError& error) {
        std::cerr << "bone_import: " << error.what() << '\n';
        return 2;
    } catch (const std::bad_alloc&) {
        std::cerr << "bone_import: out of memory; choose a smaller --region or a larger --spacing-mm\n";
    } catch (const std::exception& error) {
        std::cerr << "bone_import: " << error.what() << '\n';
    }
    return 1;
}
