// Text that comes from outside the program (names, paths, notes): its characters, checks and display.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace osteomill {

/// The characters of a text in UTF-8 (RFC 3629), one after the other. Real-time safe.
struct Utf8Character {
    std::size_t bytes = 1;  ///< that it takes; 1 for a byte that begins no character
    bool is_plain = false;  ///< a character of UTF-8 that is shown, and steers no terminal
    bool is_utf8 = false;
};

/// Whether a character ends a line, or steers a terminal: the controls C0 and C1, the separators of lines and
/// paragraphs, and Unicode's bidirectional controls, which turn the direction of the text that follows.
constexpr bool is_control(char32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x061C || code == 0x200E ||
           code == 0x200F || (code >= 0x2028 && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
}

/// The first of a text that is not empty. Overlong forms, surrogates and codes above U+10FFFF are no UTF-8.
constexpr Utf8Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t at) { return static_cast<std::uint8_t>(text[at]); };
    const std::uint8_t first = byte(0);
    if (first < 0x80) return {.bytes = 1, .is_plain = !is_control(first), .is_utf8 = true};
    const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return {};
    char32_t code = first & (0xFFU >> (bytes + 1));
    for (std::size_t at = 1; at < bytes; ++at) {
        if ((byte(at) & 0xC0U) != 0x80U) return {};
        code = code << 6U | (byte(at) & 0x3FU);
    }
    const bool is_overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    if (is_overlong || (code >= 0xD800 && code < 0xE000) || code > 0x10FFFF) return {};
    return {.bytes = bytes, .is_plain = !is_control(code), .is_utf8 = true};
}

/// Whether a file's text begins with the mark of UTF-16, in either byte order.
constexpr bool begins_as_utf16(std::string_view text) {
    return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
}

// Checks and display of names, paths and notes that come from outside the program.
//
// Text that is kept (a name in a file, an argument, a note) is checked once, on entry: it is plain, or
// refused. All displayed text goes through printable(). So no file or peer can break a log or steer a
// terminal, and a recording, whose texts are UTF-8, can always be read again.

/// Nothing for UTF-8 without control characters, line breaks and tabs among them; else what
/// is wrong, to go on behind the text's name: "is no UTF-8 (byte 2 is \xe4)".
std::optional<std::string> why_not_plain(std::string_view text);

/// Throws std::invalid_argument if it is not plain: "WHAT 'Z\xe4hne' is no UTF-8 (byte 2 is \xe4)".
void require_plain(std::string_view what, std::string_view text);

/// The text, each byte of a control character and each that is no UTF-8 as "\x1b".
std::string printable(std::string_view text);

/// The same of its first 200 bytes; a longer text is cut between characters and ends in "...".
std::string one_line(std::string_view text);

// A name of a file or folder made of a text that a person wrote, in whatever language.

/// A file system takes 255 bytes, and a character may be four.
inline constexpr std::size_t longest_file_name_characters = 60;

constexpr bool is_separator(char letter) {
    return letter == '/' || letter == '\\';
}

/// The text, cut after longest_file_name_characters; separators, control characters and bytes that are no
/// UTF-8 become _. "." and "..", which are no names, become _ and __.
inline std::string as_file_name(std::string_view text) {
    const bool is_no_name = text == "." || text == "..";
    std::string name;
    for (std::size_t characters = 0; !text.empty() && characters < longest_file_name_characters;
         ++characters) {
        const Utf8Character next = first_character(text);
        if (!next.is_plain || is_separator(text.front()) || is_no_name)
            name += '_';
        else
            name += text.substr(0, next.bytes);
        text.remove_prefix(next.bytes);
    }
    return name;
}

// Passwords in addresses (postgresql://USER:PASSWORD@HOST/NAME): found, and removed from printed or written
// text.

/// `text` with *** in the place of each password of an address or of a setting (password=...).
std::string without_passwords(const std::string& text);

/// Whether an address or a list of settings for libpq has one; also if letters are written as %XX.
bool holds_password(const std::string& address);

}  // namespace osteomill
