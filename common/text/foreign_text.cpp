#include "common/text/foreign_text.h"

#include <fmt/format.h>

#include <stdexcept>

namespace osteomill {

namespace {

constexpr std::size_t longest_line_bytes = 200;

std::string byte_text(char byte) {
    return fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
}

}  // namespace

std::optional<std::string> why_not_plain(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const Utf8Character next = first_character(text.substr(at));
        if (!next.is_plain)
            return fmt::format("{} (byte {} is {})",
                               next.is_utf8 ? "holds a control character" : "is no UTF-8", at + 1,
                               byte_text(text[at]));
        at += next.bytes;
    }
    return std::nullopt;
}

void require_plain(std::string_view what, std::string_view text) {
    if (const auto why = why_not_plain(text))
        throw std::invalid_argument(fmt::format("{} '{}' {}", what, one_line(text), *why));
}

std::string printable(std::string_view text) {
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const Utf8Character next = first_character(text);
        for (const char byte : text.substr(0, next.bytes))
            if (next.is_plain)
                shown += byte;
            else
                shown += byte_text(byte);
        text.remove_prefix(next.bytes);
    }
    return shown;
}

std::string one_line(std::string_view text) {
    std::size_t kept = 0;
    while (kept < text.size()) {
        const std::size_t next = kept + first_character(text.substr(kept)).bytes;
        if (next > longest_line_bytes) break;
        kept = next;
    }
    std::string line = printable(text.substr(0, kept));
    if (kept < text.size()) line += "...";
    return line;
}

}  // namespace osteomill
