#include "analysis/report/html_text.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace osteomill {

namespace {

struct Escape {
    char letter;
    const char* written;
};
constexpr std::array escapes{Escape{'&', "&amp;"}, Escape{'<', "&lt;"}, Escape{'>', "&gt;"},
                             Escape{'"', "&quot;"}, Escape{'\'', "&#39;"}};

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
        const auto mark = std::ranges::find(escapes, letter, &Escape::letter);
        if (mark != escapes.end())
            escaped += mark->written;
        else
            escaped += static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ? ' ' : letter;
    }
    return escaped;
}

}  // namespace osteomill
