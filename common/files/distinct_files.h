// Files of a run that must differ: two outputs at one path would lose one of them, and an output at the path
// of an input would overwrite it. Every program, and the Python module, checks this before it writes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

/// A file of a run, and the option that named it.
struct NamedFile {
    std::string option;
    std::filesystem::path path;    ///< where it is read, a folder stands for all that is in it
    bool is_written = true;        ///< otherwise it is read
    std::string names{};           ///< `path` is a folder in which files of these names (fnmatch) are written
    std::string is_replaced_by{};  ///< an option whose file may take the place of this one, once it is whole
};

/// Files of names that the program chose, in a folder of `option`.
std::vector<NamedFile> files_written_in(const std::string& option, const std::filesystem::path& folder,
                                        std::span<const char* const> names);

/// Throws std::invalid_argument with one line for the first conflict: two names of one file, also by way of
/// links or of another spelling of a folder, of which one is written; a name that another file has while it
/// is written (NAME.part.EXT); a file written into a folder that is read; and a link to write to that leads
/// to nothing. Devices and pipes may be written to by all.
void require_distinct(std::span<const NamedFile> files);

}  // namespace osteomill
