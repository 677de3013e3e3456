// Files of a command line that must differ: of two outputs at one path, one would be lost.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace osteomill {

/// A file of the command line, as what `option` named it.
struct NamedFile {
    std::string option;
    std::filesystem::path path;
    bool is_written = true;  ///< otherwise it is read
};

/// Throws std::invalid_argument with one line for the first two that are one file, also by way of links or of
/// another spelling of a folder, where either of them is written; and where one is what the other is called
/// while it is written (NAME.part.EXT). Devices and pipes may be written to by all.
void require_distinct(std::span<const NamedFile> files);

}  // namespace osteomill
