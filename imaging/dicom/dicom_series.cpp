#include "imaging/dicom/dicom_series.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "imaging/dicom/dicom_pixels.h"
#include "imaging/formats/desktop_file.h"
#include "imaging/imaging_error.h"

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
    if (!header.no_grey_image.empty())
        throw ImagingError(
            file.path, header.no_grey_image + ", which holds no CT numbers" +
                           (is_segmentation(header.scan) ? "; give it as --segmentation or --labels" : ""));
    if (!header.scan.has_pixel_data) throw ImagingError(file.path, "has no pixel data");
    if (header.samples_per_pixel != 1)
        throw ImagingError(
            file.path, fmt::format("has {} samples a pixel (colour); CT has one", header.samples_per_pixel));
    if (!header.fault.empty()) throw ImagingError(file.path, header.fault);
}

/// Files that are left out, by the reason.
class LeftOut {
  public:
    void add(const std::string& reason, const std::filesystem::path& file, const std::string& series) {
        files_[reason].push_back(file.filename().string());
        reason_of_series_[series] = reason;
    }
    std::string reason_of(const std::string& series) const {
        const auto found = reason_of_series_.find(series);
        return found == reason_of_series_.end() ? "" : found->second;
    }
    void tell(std::vector<std::string>& lines) const {
        for (const auto& [reason, files] : files_)
            lines.push_back(files.size() == 1 ? fmt::format("left out {}, which {}", files[0], reason)
                                              : fmt::format("left out {} files such as {}, which {}",
                                                            files.size(), files[0], reason));
    }

  private:
    std::map<std::string, std::vector<std::string>> files_;
    std::map<std::string, std::string> reason_of_series_;
};

/// The identity that two copies of one slice share; nothing for files of several frames.
std::optional<std::pair<std::string, std::array<double, 3>>> identity_of(const DicomHeader& header) {
    if (header.instance_uid.empty() || header.frames.size() != 1 || !header.frames[0]) return std::nullopt;
    const glm::dvec3& at = header.frames[0]->position_mm;
    return std::pair(header.instance_uid, std::array{at.x, at.y, at.z});
}

/// Leaves out images that are no slices of a scan, unless there are no others, and second copies.
void leave_out(std::vector<DicomFile>& images, LeftOut& left) {
    const auto is_other = [](const DicomFile& file) { return !file.header.not_of_the_scan.empty(); };
    const bool is_mixed = !std::all_of(images.begin(), images.end(), is_other);
    std::set<std::pair<std::string, std::array<double, 3>>> seen;
    std::vector<DicomFile> kept;
    for (DicomFile& file : images) {
        const auto identity = identity_of(file.header);
        if (is_mixed && is_other(file))
            left.add(file.header.not_of_the_scan, file.path, file.header.series_uid);
        else if (identity && !seen.insert(*identity).second)
            left.add("is a copy of another file (SOP Instance UID)", file.path, file.header.series_uid);
        else
            kept.push_back(std::move(file));
    }
    images = std::move(kept);
}

/// The best first.
std::vector<DicomSeries> find_series(const std::filesystem::path& folder, LeftOut& left) {
    std::vector<std::filesystem::path> paths;
    std::error_code failed;
    for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
        // A path that cannot even be examined, such as a link to itself, is no file.
        std::error_code unknown;
        if (entry.is_regular_file(unknown)) paths.push_back(entry.path());
        if (paths.size() > most_files)
            throw ImagingError(
                folder, fmt::format("holds more than {} files; give the folder of one series", most_files));
    }
    if (failed) throw ImagingError(folder, "cannot be listed: " + failed.message());
    if (paths.empty()) throw ImagingError(folder, "holds no files (folders in it are not searched)");
    std::sort(paths.begin(), paths.end());

    std::vector<DicomFile> images;
    std::optional<DicomFile> no_image;  // to complain of, if there is nothing else
    for (const std::filesystem::path& path : paths) {
        std::optional<DicomHeader> header = read_dicom_header(path);
        if (!header) {
            if (!is_of_the_desktop(path)) left.add("is no DICOM", path, {});
            continue;
        }
        if (!header->no_grey_image.empty()) {
            left.add(header->no_grey_image, path, header->series_uid);
            if (!no_image) no_image = DicomFile{path, *header};
        } else if (header->rows > 0 && header->columns > 0) {
            images.push_back({path, std::move(*header)});
        }  // else it is a DICOMDIR or the like
    }
    if (images.empty() && no_image) require_usable(*no_image);
    if (images.empty())
        throw ImagingError(
            folder,
            "holds no DICOM images, nor slices as PNG or TIFF (folders in it are not searched); "
            "a scan in one file is given by that file's name");
    leave_out(images, left);
    std::map<std::string, DicomSeries> by_uid;
    for (DicomFile& file : images) {
        DicomSeries& series = by_uid[file.header.series_uid];
        add(series, std::move(file));
    }
    std::vector<DicomSeries> found;
    for (auto& [uid, series] : by_uid) found.push_back(std::move(series));
    const auto is_ct = [](const DicomSeries& series) {
        return series.files.front().header.scan.modality == "CT";
    };
    std::stable_sort(found.begin(), found.end(), [&](const DicomSeries& a, const DicomSeries& b) {
        return std::tuple(a.slices > 1, is_ct(a), a.slices) > std::tuple(b.slices > 1, is_ct(b), b.slices);
    });
    return found;
}

}  // namespace

DicomSeries choose_series(const std::filesystem::path& folder, const std::optional<std::string>& uid,
                          std::vector<std::string>& notes) {
    LeftOut left;
    const std::vector<DicomSeries> series = find_series(folder, left);
    const auto chosen = uid ? std::ranges::find(series, *uid, &DicomSeries::uid) : series.begin();
    if (chosen == series.end()) {
        if (const std::string reason = left.reason_of(*uid); !reason.empty())
            throw ImagingError(folder,
                               fmt::format("its series {} is left out beside the others, as it {}; give "
                                           "its files in a folder of their own",
                                           *uid, reason));
        std::string known;
        for (const DicomSeries& one : series) known += (known.empty() ? "" : ", ") + described(one);
        throw ImagingError(folder, fmt::format("holds no series {}; it holds {}", *uid, known));
    }
    for (const DicomSeries& one : series)
        if (&one != &*chosen)
            notes.push_back(fmt::format("passed over series {}; --series picks one", described(one)));
    left.tell(notes);
    if (chosen->slices == 1 && !notes.empty())
        throw ImagingError(folder, fmt::format("of series {} it holds a single slice, which is no volume; {}",
                                               chosen->uid, fmt::join(notes, "; ")));
    return *chosen;
}

DicomSeries series_of_file(const std::filesystem::path& path) {
    std::optional<DicomHeader> header = read_dicom_header(path);
    if (!header) throw ImagingError(path, "is not DICOM");
    if ((header->rows == 0 || header->columns == 0) && header->no_grey_image.empty())
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
