// A short line of text that lies within the value it belongs to, so that real-time code can copy it. Always
// UTF-8 without control characters.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/text/foreign_text.h"

namespace osteomill {

class BoundedLine {
  public:
    /// Longer than any fault's text.
    static constexpr std::size_t most_bytes = 207;

    constexpr BoundedLine() = default;
    /// A text longer than most_bytes is cut between characters; each control character, and each byte that is
    /// no UTF-8, becomes '?'. Real-time safe.
    template <std::convertible_to<std::string_view> Text>
    constexpr BoundedLine(const Text& text) noexcept {
        std::size_t size = 0;
        for (std::string_view rest(text); !rest.empty();) {
            const Utf8Character next = first_character(rest);
            const std::string_view shown = next.is_plain ? rest.substr(0, next.bytes) : "?";
            if (size + shown.size() > most_bytes) break;
            std::copy_n(shown.begin(), shown.size(), bytes_.begin() + static_cast<std::ptrdiff_t>(size));
            size += shown.size();
            rest.remove_prefix(next.bytes);
        }
        size_ = static_cast<std::uint8_t>(size);
    }

    constexpr std::string_view text() const noexcept { return {bytes_.data(), size_}; }
    constexpr bool empty() const noexcept { return size_ == 0; }
    friend constexpr bool operator==(const BoundedLine& a, const BoundedLine& b) noexcept {
        return a.text() == b.text();
    }

  private:
    std::array<char, most_bytes> bytes_{};
    std::uint8_t size_ = 0;
};

}  // namespace osteomill
