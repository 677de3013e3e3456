// Words in a text, as against units, signs and places for values.
#pragma once

#include <cctype>
#include <string>

namespace osteomill::testing {

/// Three small letters in a row: no unit, no place for a value.
inline bool has_word(const std::string& text) {
    int letters = 0;
    for (const char letter : text) {
        letters = std::islower(static_cast<unsigned char>(letter)) ? letters + 1 : 0;
        if (letters == 3) return true;
    }
    return false;
}

}  // namespace osteomill::testing
