// What every reader and writer of images throws: one line that names the file and the reason.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace osteomill {

class ImagingError : public std::runtime_error {
  public:
    explicit ImagingError(const std::string& line) : std::runtime_error(on_one_line(line)) {}
    ImagingError(const std::filesystem::path& file, const std::string& reason)
        : ImagingError(file.string() + ": " + reason) {}

  private:
    /// Names and header fields may hold line breaks, and sequences that a terminal obeys.
    static std::string on_one_line(std::string line) {
        const auto is_control = [](char letter) {
            return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f;
        };
        std::replace_if(line.begin(), line.end(), is_control, ' ');
        return line;
    }
};

}  // namespace osteomill
