#include "imaging/case/case_trust.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <stdexcept>
#include <string_view>
#include <variant>
#include <vector>

#include "common/files/inside_folder.h"
#include "common/scene/toml_text.h"
#include "imaging/bone_file/digest.h"
#include "imaging/bone_file/hu_file.h"

namespace osteomill {

namespace {

constexpr std::string_view digest_mark = "# osteomill_digest: ";

std::string digest_of(std::string_view text) {
    Digest digest;
    digest.add(std::as_bytes(std::span(text)));
    return digest.text();
}

/// Empty if the text is as it was written.
std::string doubt_of(std::string_view text) {
    const std::size_t at = text.rfind(digest_mark);
    if (at == std::string_view::npos) return " (no digest)";
    const bool is_right =
        text.substr(at) == fmt::format("{}{}\n", digest_mark, digest_of(text.substr(0, at)));
    return is_right ? "" : " (edited since it was written)";
}

std::string name_of(const std::filesystem::path& file) {
    return file.filename().string();
}

}  // namespace

void require_own_files(const Scene& scene, const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (const auto* bone = std::get_if<FileSource>(&scene.bone)) {
        files.push_back(bone->path);
        if (!bone->segmentation.empty()) files.push_back(bone->segmentation);
    }
    if (const auto* trajectory = std::get_if<std::filesystem::path>(&scene.trajectory.source))
        files.push_back(*trajectory);
    for (const auto& file : files)
        if (!lies_inside(file, folder))
            throw std::runtime_error(
                fmt::format("{}: lies outside the folder of the case that names it, {}; a case holds its own "
                            "files, others are for --scene",
                            file.string(), folder.string()));
}

std::string with_digest(std::string text) {
    return text + fmt::format("{}{}\n", digest_mark, digest_of(text));
}

std::string unsigned_files(const Scene& scene, const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const char* name : {"case.toml", "placement.toml"}) {
        std::error_code failed;
        if (!std::filesystem::exists(folder / name, failed)) continue;
        const std::string doubt = doubt_of(read_toml_text(folder / name, "a file of a case"));
        if (!doubt.empty()) names.push_back(name + doubt);
    }
    if (const auto* bone = std::get_if<FileSource>(&scene.bone)) {
        const BoneFile file(bone->path);
        if (!file.key_values().contains(header_digest_key) || !file.key_values().contains(hu_digest_key))
            names.push_back(name_of(bone->path) + " (no digest)");
        const auto& segmentation = bone->segmentation;
        if (!segmentation.empty() && !has_file_digest(segmentation))
            names.push_back(name_of(segmentation) + " (no digest)");
    }
    if (names.empty()) return {};
    return fmt::format("{}: unsigned: {}; damage to what is unsigned would not be noticed", folder.string(),
                       fmt::join(names, ", "));
}

}  // namespace osteomill
