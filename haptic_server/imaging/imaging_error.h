// What every reader and writer of images throws: one line that names the file and the reason.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace osteomill {

class ImagingError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
    ImagingError(const std::filesystem::path& file, const std::string& reason)
        : std::runtime_error(file.string() + ": " + reason) {}
};

}  // namespace osteomill
