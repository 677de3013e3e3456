#include "haptic_server/imaging/dicom/dicom_series.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "haptic_server/imaging/imaging_error.h"

namespace osteomill {

namespace {

/// No series has so many; every file is opened.
constexpr std::size_t most_files = 65535;

std::string described(const DicomSeries& series) {
    return fmt::format("{} ({}{}{} slices)", series.uid, series.description,
                       series.description.empty() ? "" : ", ", series.slices);
}

void add(DicomSeries& series, DicomFile file) {
    series.uid = file.header.series_uid;
    series.description = file.header.series_description;
    series.slices += file.header.frames.size();
    series.files.push_back(std::move(file));
}

void require_usable(const DicomFile& file) {
    const DicomHeader& header = file.header;
    if (!header.has_pixel_data) throw ImagingError(file.path, "has no pixel data");
    if (header.samples_per_pixel != 1)
        throw ImagingError(
            file.path, fmt::format("has {} samples a pixel (colour); CT has one", header.samples_per_pixel));
    if (!header.no_grey_image.empty())
        throw ImagingError(file.path, header.no_grey_image + ", which holds no CT numbers");
    if (!header.fault.empty()) throw ImagingError(file.path, header.fault);
}

}  // namespace

std::vector<DicomSeries> find_series(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        // What cannot even be looked at, as a link to itself, is no file.
        std::error_code unknown;
        if (entry.is_regular_file(unknown)) paths.push_back(entry.path());
        if (paths.size() > most_files)
            throw ImagingError(
                folder, fmt::format("holds more than {} files; give the folder of one series", most_files));
    }
    if (failed) throw ImagingError(folder, "cannot be listed: " + failed.message());
    if (paths.empty()) throw ImagingError(folder, "holds no files (folders in it are not searched)");
    std::sort(paths.begin(), paths.end());

    std::map<std::string, DicomSeries> by_uid;
    std::map<std::string, DicomSeries> no_images;
    for (const std::filesystem::path& path : paths) {
        std::optional<DicomHeader> header = read_dicom_header(path);
        // Reports, presentation states and a DICOMDIR are DICOM, but no image.
        if (!header || header->rows == 0 || header->columns == 0) continue;
        DicomSeries& series = (header->no_grey_image.empty() ? by_uid : no_images)[header->series_uid];
        add(series, {path, std::move(*header)});
    }
    // A segmentation beside its scan may have more frames than that, and is not it.
    if (by_uid.empty() && !no_images.empty()) require_usable(no_images.begin()->second.files.front());
    if (by_uid.empty()) throw ImagingError(folder, "holds no DICOM images");
    std::vector<DicomSeries> found;
    for (auto& [uid, series] : by_uid) found.push_back(std::move(series));
    std::stable_sort(found.begin(), found.end(),
                     [](const DicomSeries& a, const DicomSeries& b) { return a.slices > b.slices; });
    return found;
}

const DicomSeries& choose_series(const std::filesystem::path& folder, const std::vector<DicomSeries>& series,
                                 const std::optional<std::string>& uid, std::vector<std::string>& others) {
    auto chosen = series.begin();
    if (uid)
        chosen = std::find_if(series.begin(), series.end(), [&](const auto& one) { return one.uid == *uid; });
    if (chosen == series.end()) {
        std::string known;
        for (const DicomSeries& one : series) known += (known.empty() ? "" : ", ") + described(one);
        throw ImagingError(folder, fmt::format("holds no series {}; it holds {}", *uid, known));
    }
    for (const DicomSeries& one : series)
        if (&one != &*chosen) others.push_back(described(one));
    return *chosen;
}

DicomSeries series_of_file(const std::filesystem::path& path) {
    std::optional<DicomHeader> header = read_dicom_header(path);
    if (!header) throw ImagingError(path, "is not DICOM");
    if (header->rows == 0 || header->columns == 0)
        throw ImagingError(path, "has no pixel data (it is DICOM, but no image)");
    DicomSeries series;
    add(series, {path, std::move(*header)});
    return series;
}

std::vector<DicomSlice> slices_of(const DicomSeries& series) {
    std::vector<DicomSlice> slices;
    for (const DicomFile& file : series.files) {
        require_usable(file);
        const std::vector<std::optional<SlicePlacement>>& frames = file.header.frames;
        for (std::size_t frame = 0; frame < frames.size(); ++frame) {
            DicomSlice slice{
                .placement = *frames[frame], .file = file.path, .frame = static_cast<unsigned>(frame)};
            slice.placement.name = file.path.filename().string();
            if (frames.size() > 1) slice.placement.name += fmt::format(" frame {}", frame + 1);
            slices.push_back(std::move(slice));
        }
    }
    return slices;
}

}  // namespace osteomill
