// A digest of bytes: 128 bits of XXH3, which tells a damaged channel from the one that was saved. It guards
// against accidents, not against forgers.
#pragma once

#include <xxhash.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace osteomill {

class Digest {
  public:
    static constexpr std::size_t text_length = 32;

    Digest();
    void add(std::span<const std::byte> bytes);
    /// The digest of all bytes so far: 32 hexadecimal digits.
    std::string text() const;

  private:
    struct Free {
        void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
    };
    std::unique_ptr<XXH3_state_t, Free> state_;
};

}  // namespace osteomill
