// Listing of a folder, for the choice of a scan.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace osteomill {

struct FolderListing {
    std::filesystem::path folder;        ///< absolute
    std::vector<std::string> folders{};  ///< by name, without hidden ones
    std::vector<std::string> files{};    ///< likewise
    std::string problem{};               ///< why it cannot be read, one line; empty: it can
};

/// Shows at most so many of either; the rest is in `problem`.
inline constexpr std::size_t most_listed = 2000;

FolderListing list_folder(const std::filesystem::path& folder);

}  // namespace osteomill
