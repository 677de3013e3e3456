#include "render_client/ui/start/folder_listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "common/words/translation.h"

namespace osteomill {

namespace {

bool ends_with_one_of(const std::string& name, const std::vector<std::string>& endings) {
    std::string ending = std::filesystem::path(name).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char letter) { return std::tolower(letter); });
    return endings.empty() || std::ranges::find(endings, ending) != endings.end();
}

}  // namespace

FolderListing list_folder(const std::filesystem::path& folder, const std::vector<std::string>& endings) {
    std::error_code error;
    FolderListing listing{.folder = std::filesystem::absolute(folder, error).lexically_normal()};
    if (!listing.folder.has_filename()) listing.folder = listing.folder.parent_path();
    std::filesystem::directory_iterator entry(listing.folder, error);
    for (; !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (name.empty() || name.front() == '.') continue;
        std::error_code ignored;
        if (entry->is_directory(ignored))
            listing.folders.push_back(name);
        else if (ends_with_one_of(name, endings))
            listing.files.push_back(name);
    }
    if (error) listing.problem = trf("{}: cannot be read: {}", listing.folder.string(), error.message());
    for (auto* names : {&listing.folders, &listing.files}) {
        std::sort(names->begin(), names->end());
        if (names->size() <= most_listed) continue;
        listing.problem = trf("only {} of {} are shown", most_listed, names->size());
        names->resize(most_listed);
    }
    return listing;
}

}  // namespace osteomill
