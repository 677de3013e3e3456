// Zstandard compression of one block of bytes after another, with a context and a buffer that are kept.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct ZSTD_CCtx_s;

namespace osteomill {

class ZstdCompressor {
  public:
    /// `level` as Zstandard counts: 1 is fast, higher is smaller. Throws std::bad_alloc.
    explicit ZstdCompressor(int level);

    /// A frame of its own for each block. Valid until the next call. Throws std::runtime_error with the
    /// library's reason.
    std::span<const std::uint8_t> compress(std::span<const std::uint8_t> bytes);

  private:
    struct Free {
        void operator()(ZSTD_CCtx_s* context) const;
    };
    int level_;
    std::unique_ptr<ZSTD_CCtx_s, Free> context_;
    std::vector<std::uint8_t> compressed_;
};

}  // namespace osteomill
