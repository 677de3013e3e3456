// A recording as an HDF5 file, for Python, MATLAB and whatever else reads HDF5. Layouts: docs/hdf5.md.
#pragma once

#include <array>
#include <filesystem>
#include <string>

#include "common/program/progress.h"

namespace osteomill {

enum class Hdf5Layout {
    osteomill,  ///< all that the recording holds
    fivrs,      ///< the old layout of FIVRS's recordings, which its analysis programs read
    fivrs_v3,   ///< the same, and a second file in the folder v3/ beside it, which links into it
};
inline constexpr std::array hdf5_layout_names{"osteomill", "fivrs", "fivrs-v3"};

/// The path of fivrs_v3's second file; it has a folder of its own, since readers open every file of a folder.
std::filesystem::path fivrs_v3_file(const std::filesystem::path& file);

/// Replaces `file` once all is written; `on_frame` is called before each frame. Returns, in one line, why the
/// recording could not be read further, and the file then has the part before; empty at the recording's end.
/// Throws RecordingError if there is no bone in it, and std::runtime_error in one line if the file cannot be
/// written or several sessions were joined, std::invalid_argument if it is the recording itself
/// (distinct_files.h).
std::string write_hdf5(const std::filesystem::path& recording, const std::filesystem::path& file,
                       Hdf5Layout layout, const ReportProgress& on_frame);

}  // namespace osteomill
