// Error that every reader and writer of images throws: one line that names the file and the reason.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "common/text/foreign_text.h"

namespace osteomill {

class ImagingError : public std::runtime_error {
  public:
    explicit ImagingError(const std::string& line) : std::runtime_error(printable(line)) {}
    ImagingError(const std::filesystem::path& file, const std::string& reason)
        : ImagingError(file.string() + ": " + reason) {}
};

/// The result of `work`. If it throws std::invalid_argument, that becomes an ImagingError that names this
/// file.
template <typename Work>
auto said_of(const std::filesystem::path& file, Work&& work) {
    try {
        return work();
    } catch (const std::invalid_argument& error) {
        throw ImagingError(file, error.what());
    }
}

}  // namespace osteomill
