// Listing of a folder, for the choice of a scan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace osteomill {

struct FolderListing {
    std::filesystem::path folder;        ///< absolute
    std::vector<std::string> folders{};  ///< by name, without hidden ones
    std::vector<std::string> files{};    ///< by name, without hidden ones
    std::string problem{};               ///< why it cannot be read, one line; empty: it can
};

/// Shows at most so many of either; the rest is in `problem`.
inline constexpr std::size_t most_listed = 2000;

/// All files, or those with one of these endings, such as ".csv", in capitals or not.
FolderListing list_folder(const std::filesystem::path& folder, const std::vector<std::string>& endings = {});

}  // namespace osteomill
