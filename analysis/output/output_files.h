// Files that a study leaves behind. Everything throws std::runtime_error in one line naming the path that
// cannot be written.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace osteomill::study {

/// Makes the folder and those above it; nothing happens where it is there.
void make_folder(const std::filesystem::path& folder);
void write_text(const std::string& text, const std::filesystem::path& file);
void write_json(const nlohmann::ordered_json& json, const std::filesystem::path& file);

}  // namespace osteomill::study
