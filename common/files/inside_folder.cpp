#include "common/files/inside_folder.h"

#include <algorithm>
#include <system_error>

namespace osteomill {

bool lies_inside(const std::filesystem::path& file, const std::filesystem::path& folder) {
    std::error_code failed;
    const std::filesystem::path outer = std::filesystem::canonical(folder.empty() ? "." : folder, failed);
    if (failed) return false;
    const std::filesystem::path inner =
        std::filesystem::weakly_canonical(std::filesystem::absolute(file, failed), failed);
    if (failed) return false;
    const auto [outer_end, unused] = std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end());
    return outer_end == outer.end();
}

}  // namespace osteomill
