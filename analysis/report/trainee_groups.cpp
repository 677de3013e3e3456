#include "analysis/report/trainee_groups.h"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>
#include <vector>

#include "common/files/input_file.h"
#include "common/text/plain_text.h"
#include "common/text/words.h"

namespace osteomill {

std::map<std::string, std::string> trainee_groups(const std::filesystem::path& file) {
    std::istringstream lines(read_text(file, table_kind));
    std::map<std::string, std::string> groups;
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (trimmed(line).empty()) continue;
        const auto fail = [&](const std::string& why) {
            throw std::runtime_error(printable(fmt::format("{}:{}: {}", file.string(), number, why)));
        };
        const std::size_t comma = line.rfind(',');
        if (comma == std::string::npos) fail("a line is TRAINEE,GROUP");
        const std::string trainee = trimmed(line.substr(0, comma));
        const std::string group = trimmed(line.substr(comma + 1));
        if (number == 1 && trainee == "trainee" && group == "group") continue;
        if (trainee.empty() || group.empty()) fail("a line is TRAINEE,GROUP, and neither is empty");
        if (const auto [known, is_new] = groups.emplace(trainee, group); !is_new && known->second != group)
            fail(fmt::format("\"{}\" is in group \"{}\" already", trainee, known->second));
    }
    return groups;
}

}  // namespace osteomill
