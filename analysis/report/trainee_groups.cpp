#include "analysis/report/trainee_groups.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/files/input_file.h"
#include "common/files/table_line.h"
#include "common/text/plain_text.h"
#include "common/text/words.h"

namespace osteomill {

std::map<std::string, std::string> trainee_groups(const std::filesystem::path& file) {
    std::istringstream lines(read_text(file, table_kind));
    std::map<std::string, std::string> groups;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto fail = [&](const std::string& why) {
            throw std::runtime_error(printable(fmt::format("{}:{}: {}", file.string(), number, why)));
        };
        try {
            strip_line(line, ++number == 1);
        } catch (const std::runtime_error& error) {
            fail(error.what());
        }
        if (trimmed(line).empty()) continue;
        std::vector<std::string> cells = quoted_cells(line, line.find(';') == std::string::npos ? ',' : ';');
        if (cells.size() < 2) fail("a line is TRAINEE,GROUP");
        const std::string group = trimmed(cells.back());
        cells.pop_back();
        const std::string trainee = trimmed(fmt::format("{}", fmt::join(cells, ",")));
        if (number == 1 && trainee == "trainee" && group == "group") continue;
        if (trainee.empty() || group.empty()) fail("a line is TRAINEE,GROUP, and neither is empty");
        if (const auto [known, is_new] = groups.emplace(trainee, group); !is_new && known->second != group)
            fail(fmt::format("\"{}\" is in group \"{}\" already", trainee, known->second));
    }
    return groups;
}

}  // namespace osteomill
