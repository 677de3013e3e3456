#include "render_client/ui/start/folder_listing.h"

#include <fmt/format.h>

#include <algorithm>

namespace osteomill {

FolderListing list_folder(const std::filesystem::path& folder) {
    std::error_code error;
    FolderListing listing{.folder = std::filesystem::absolute(folder, error).lexically_normal()};
    if (!listing.folder.has_filename()) listing.folder = listing.folder.parent_path();
    std::filesystem::directory_iterator entry(listing.folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.empty() || name.front() == '.') continue;
        std::error_code ignored;
        auto& names = entry->is_directory(ignored) ? listing.folders : listing.files;
        names.push_back(name);
    }
    if (error)
        listing.problem = fmt::format("{}: cannot be read: {}", listing.folder.string(), error.message());
    for (auto* names : {&listing.folders, &listing.files}) {
        std::sort(names->begin(), names->end());
        if (names->size() <= most_listed) continue;
        listing.problem = fmt::format("only {} of {} are shown", most_listed, names->size());
        names->resize(most_listed);
    }
    return listing;
}

}  // namespace osteomill
