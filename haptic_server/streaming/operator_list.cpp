#include "haptic_server/streaming/operator_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "common/text/pattern.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::size_t longest_line_bytes = 1000;
/// TYPE=VALUE, several joined by a comma or, within one set, by a plus. With spaces around these it would be
/// a subject as OpenSSL prints it otherwise, and match nobody.
bool is_subject(const std::string& line) {
    const std::string type = "([A-Za-z][A-Za-z0-9-]*|[0-9]+(\\.[0-9]+)*)";
    const std::string character = "([^,+\"\\\\<>;=]|\\\\.)";
    const std::string value = "([^,+\"\\\\<>;= ]|\\\\.)" + character + "*";
    static const Pattern subject(type + "=" + value + "([,+]" + type + "=" + value + ")*");
    return line.size() <= longest_line_bytes && subject.takes(line);
}

}  // namespace

OperatorList::OperatorList(const std::filesystem::path& file) {
    std::istringstream in(read_text(file, operators_kind));
    std::string text;
    for (int number = 1; std::getline(in, text); ++number) {
        const std::string line = trimmed(text);
        if (line.empty() || line.front() == '#') continue;
        const bool is_plain =
            std::ranges::all_of(line, [](unsigned char c) { return c >= 0x20 && c < 0x7f; });
        if (!is_plain || !is_subject(line))
            throw std::runtime_error(fmt::format(
                "{}:{}: {} is no subject of a certificate in the form of RFC 2253, such as CN=viewer",
                file.string(), number, is_plain ? "'" + line.substr(0, 80) + "'" : "what stands there"));
        subjects_.insert(line);
    }
    if (subjects_.empty())
        throw std::runtime_error(fmt::format("{}: names nobody who may move the tool", file.string()));
}

}  // namespace osteomill
