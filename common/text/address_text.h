// Passwords in addresses (postgresql://USER:PASSWORD@HOST/NAME): found, and removed from printed or written
// text.
#pragma once

#include <cctype>
#include <regex>
#include <string>

namespace osteomill {

/// `text` with *** in the place of each password of an address or of a setting (password=...).
inline std::string without_passwords(const std::string& text) {
    static const std::regex of_address(R"((://[^\s/@:?]*:)\S*@)");
    static const std::regex of_setting(R"re((password\s*=\s*)('(\\.|[^'\\])*'|[^\s&'"]+))re",
                                       std::regex::icase);
    return std::regex_replace(std::regex_replace(text, of_address, "$1***@"), of_setting, "$1***");
}

/// Whether an address or a list of settings for libpq has one; also if letters are written as %XX.
inline bool holds_password(const std::string& address) {
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
