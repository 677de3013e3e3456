#include "common/text/foreign_text.h"

#include <fmt/format.h>

#include <cctype>
#include <regex>
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

std::string without_passwords(const std::string& text) {
    static const std::regex of_address(R"((://[^\s/@:?]*:)\S*@)");
    static const std::regex of_setting(R"re((password\s*=\s*)('(\\.|[^'\\])*'|[^\s&'"]+))re",
                                       std::regex::icase);
    return std::regex_replace(std::regex_replace(text, of_address, "$1***@"), of_setting, "$1***");
}

bool holds_password(const std::string& address) {
    std::string plain;
    for (std::size_t i = 0; i < address.size(); ++i) {
        const auto is_hex = [&](std::size_t at) {
            return at < address.size() && std::isxdigit(static_cast<unsigned char>(address[at])) != 0;
        };
        if (address[i] == '%' && is_hex(i + 1) && is_hex(i + 2)) {
            plain += static_cast<char>(std::stoi(address.substr(i + 1, 2), nullptr, 16));
            i += 2;
        } else {
            plain += address[i];
        }
    }
    // Digits behind a host are a port, up to the path.
    static const std::regex password(R"(://[^/@:?]*:(?!\d{0,5}([/?,]|$))[^@]*@|password\s*=)",
                                     std::regex::icase);
    return std::regex_search(address, password) || std::regex_search(plain, password);
}

}  // namespace osteomill
