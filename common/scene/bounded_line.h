// A short line of text that lies within the value it belongs to, so that real-time code can copy it.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace osteomill {

class BoundedLine {
  public:
    /// Room for all that one_line() (wire_error.h) leaves of what a peer sent, and more than any fault needs.
    static constexpr std::size_t most_bytes = 207;

    constexpr BoundedLine() = default;
    /// Whatever is longer than most_bytes is cut. Real-time safe.
    template <std::convertible_to<std::string_view> Text>
    constexpr BoundedLine(const Text& text) noexcept {
        const std::string_view view(text);
        size_ = static_cast<std::uint8_t>(std::min(view.size(), most_bytes));
        std::copy_n(view.begin(), size_, bytes_.begin());
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
