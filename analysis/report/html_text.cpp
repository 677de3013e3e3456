#include "analysis/report/html_text.h"

#include <nlohmann/json.hpp>

namespace osteomill {

namespace {

/// By the library that checks every byte of it anyway.
std::string valid_utf8(std::string_view text) {
    const nlohmann::json quoted(std::string{text});
    return nlohmann::json::parse(quoted.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
        .get<std::string>();
}

}  // namespace

std::string html_text(std::string_view text) {
    std::string escaped;
    for (const char letter : valid_utf8(text)) {
        switch (letter) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ? ' ' : letter;
        }
    }
    return escaped;
}

}  // namespace osteomill
