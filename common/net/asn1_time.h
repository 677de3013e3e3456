// A time in a certificate or a list of revoked ones, for a message.
#pragma once

#include <openssl/asn1.h>

#include <array>
#include <ctime>
#include <string>

namespace osteomill {

/// Such as "2026-11-22 19:30:00 UTC".
inline std::string text_of(const ASN1_TIME& time) {
    std::tm parts{};
    std::array<char, 64> text{};
    if (ASN1_TIME_to_tm(&time, &parts) != 1 ||
        std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S UTC", &parts) == 0)
        return "an unknown time";
    return text.data();
}

}  // namespace osteomill
