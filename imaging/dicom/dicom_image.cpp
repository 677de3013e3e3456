#include "imaging/dicom/dicom_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "imaging/dicom/dicom_frames.h"
#include "imaging/dicom/dicom_segmentation.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// Notes the doubts about files that are read nevertheless.
void note_doubts(const std::filesystem::path& folder, const DicomSeries& series, SourceImage& image) {
    const auto is_wrong = [](const DicomFile& file) { return file.header.sign_of_codestream.has_value(); };
    if (const auto wrong = std::ranges::count_if(series.files, is_wrong); wrong > 0) {
        const bool is_signed = *std::ranges::find_if(series.files, is_wrong)->header.sign_of_codestream;
        image.notes.push_back(fmt::format(
            "{}: warning: {} file(s) say {} pixels (0028,0103) where their JPEG 2000 codestream says {}; the "
            "codestream is followed",
            folder.string(), wrong, is_signed ? "unsigned" : "signed", is_signed ? "signed" : "unsigned"));
    }
    std::set<std::string> notes;
    for (const DicomFile& file : series.files)
        notes.insert(file.header.notes.begin(), file.header.notes.end());
    for (const std::string& note : notes) image.notes.push_back(fmt::format("{}: {}", folder.string(), note));
    double lowest = std::numeric_limits<double>::max(), highest = std::numeric_limits<double>::lowest();
    for (const DicomFile& file : series.files)
        for (const DicomRescale& rescale : file.header.rescales) {
            lowest = std::min(lowest, rescale.intercept);
            highest = std::max(highest, rescale.intercept);
        }
    constexpr double most_difference_hu = 100.0;
    if (highest - lowest > most_difference_hu)
        image.notes.push_back(
            fmt::format("{}: warning: its slices say Rescale Intercepts (0028,1052) from {:g} to "
                        "{:g}; those of a CT are alike",
                        folder.string(), lowest, highest));
    const std::string& modality = series.files.front().header.scan.modality;
    if (!modality.empty() && modality != "CT")
        image.notes.push_back(
            fmt::format("{}: warning: its modality is {}, not CT; its values are taken for "
                        "HU unless --rescale or --intensity-window makes HU of them",
                        folder.string(), modality));
}

void read_stack(const std::vector<DicomSlice>& slices, const std::vector<std::size_t>& order,
                const std::map<std::filesystem::path, DicomHeader>& header_of_file, const TakeSlice& take,
                const ReportProgress& report) {
    std::optional<DicomFrames> frames;
    std::filesystem::path open;
    for (std::size_t k = 0; k < order.size(); ++k) {
        const DicomSlice& slice = slices[order[k]];
        if (slice.file != open) {
            frames.reset();
            frames.emplace(DicomFile{slice.file, header_of_file.at(slice.file)});
        }
        open = slice.file;
        take(static_cast<int>(k), frames->frame(slice.frame));
        report(static_cast<double>(k + 1) / static_cast<double>(order.size()));
    }
}

OpenedImage open_series(const std::filesystem::path& folder, const DicomSeries& series) {
    const std::vector<DicomSlice> slices = slices_of(series);
    std::vector<SlicePlacement> placements;
    for (const DicomSlice& slice : slices) placements.push_back(slice.placement);
    const SliceStack stack = said_of(folder, [&] { return stack_slices(placements); });
    std::map<std::filesystem::path, DicomHeader> header_of_file;
    for (const DicomFile& file : series.files) header_of_file[file.path] = file.header;

    OpenedImage opened;
    opened.image.size_voxels = {placements.front().columns, placements.front().rows,
                                static_cast<int>(placements.size())};
    opened.image.spacing_mm = stack.spacing_mm;
    opened.image.origin_mm = stack.origin_mm;
    opened.image.direction = stack.direction;
    settle_geometry(opened.image, folder);
    note_doubts(folder, series, opened.image);
    opened.read_slices = [slices, order = stack.order, header_of_file](const TakeSlice& take,
                                                                       const ReportProgress& report) {
        read_stack(slices, order, header_of_file, take, report);
    };
    for (const DicomFile& file : series.files)
        opened.reading_bytes = std::max(opened.reading_bytes, DicomFrames::bytes_to_read(file));
    return opened;
}

}  // namespace

namespace {

/// The only segmentation of a folder; nothing if there is none.
std::optional<std::filesystem::path> segmentation_in(const std::filesystem::path& folder) {
    std::optional<std::filesystem::path> found;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        std::error_code unknown;
        if (!entry.is_regular_file(unknown) || !is_dicom_segmentation(entry.path())) continue;
        if (found)
            throw ImagingError(folder,
                               fmt::format("holds several segmentations, such as {} and {}; give one of them",
                                           found->filename().string(), entry.path().filename().string()));
        found = entry.path();
    }
    return found;
}

}  // namespace

OpenedImage open_dicom_folder(const std::filesystem::path& folder,
                              const std::optional<std::string>& series_uid, ImagePurpose purpose) {
    if (purpose == ImagePurpose::labels)
        if (const auto segmentation = segmentation_in(folder)) return open_dicom_segmentation(*segmentation);
    std::vector<std::string> notes;
    OpenedImage opened = open_series(folder, choose_series(folder, series_uid, notes));
    for (const std::string& note : notes)
        opened.image.notes.push_back(fmt::format("{}: {}", folder.string(), note));
    return opened;
}

OpenedImage open_dicom_file(const std::filesystem::path& path, ImagePurpose purpose) {
    if (purpose == ImagePurpose::labels && is_dicom_segmentation(path)) return open_dicom_segmentation(path);
    return open_series(path, series_of_file(path));
}

}  // namespace osteomill
