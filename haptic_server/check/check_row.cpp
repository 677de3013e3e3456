#include "haptic_server/check/check_row.h"

#include <fmt/format.h>

#include <algorithm>

namespace osteomill {

std::string text_of(const std::vector<CheckRow>& rows) {
    std::string text;
    std::size_t wrong = 0;
    std::size_t waiting = 0;
    for (const CheckRow& row : rows) {
        const char* const verdict = row.is_right() ? "right" : row.can_wait ? "could be better" : "wrong";
        text += fmt::format("{:<16} {:<22} {}\n", verdict, row.what, row.found);
        if (row.is_right()) continue;
        ++(row.can_wait ? waiting : wrong);
        text += fmt::format("{:<16} costs: {}\n{:<16} mend:  {}\n", "", row.cost, "", row.mend);
    }
    return text + fmt::format("{} looked at, {} wrong, {} could be better\n", rows.size(), wrong, waiting);
}

bool must_be_mended(const std::vector<CheckRow>& rows) {
    return std::ranges::any_of(rows, [](const CheckRow& row) { return !row.is_right() && !row.can_wait; });
}

}  // namespace osteomill
