#include "common/scene/nearest_name.h"

#include <algorithm>
#include <numeric>

namespace osteomill {

namespace {

bool begins_like(std::string_view a, std::string_view b) {
    constexpr std::size_t fewest_letters = 3;
    const std::string_view shorter = a.size() < b.size() ? a : b;
    const std::string_view longer = a.size() < b.size() ? b : a;
    return shorter.size() >= fewest_letters && longer.starts_with(shorter);
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // One row of the table of distances between all beginnings of `a` and of `b`.
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

std::optional<std::string> nearest_name(std::string_view written, const std::vector<std::string>& names) {
    std::optional<std::string> nearest;
    std::size_t fewest_changes = 0;
    for (const std::string& name : names) {
        const std::size_t changes = edit_distance(written, name);
        if (!begins_like(written, name) && 2 * changes > std::max(written.size(), name.size())) continue;
        if (nearest && changes >= fewest_changes) continue;
        nearest = name;
        fewest_changes = changes;
    }
    return nearest;
}

std::optional<std::string> same_name(std::string_view written, const std::vector<std::string>& names) {
    const auto is_like = [&](const std::string& name) {
        return std::ranges::equal(
            written, name, [](char a, char b) { return (a == '_' ? ' ' : a) == (b == '_' ? ' ' : b); });
    };
    if (std::ranges::find(names, written) != names.end()) return std::string(written);
    const auto found = std::ranges::find_if(names, is_like);
    if (found == names.end() || std::ranges::count_if(names, is_like) > 1) return std::nullopt;
    return *found;
}

}  // namespace osteomill
