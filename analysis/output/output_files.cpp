#include "analysis/output/output_files.h"

#include <stdexcept>

#include "common/files/atomic_file.h"

namespace osteomill::study {

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw std::runtime_error(folder.string() + ": cannot be made a folder: " + error.message());
}

void write_text(const std::string& text, const std::filesystem::path& file) {
    write_atomic_file(file, text, Link::replace);
}

void write_json(const nlohmann::ordered_json& json, const std::filesystem::path& file) {
    write_text(json.dump(1) + '\n', file);
}

}  // namespace osteomill::study
