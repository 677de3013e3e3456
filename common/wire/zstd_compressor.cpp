#include "common/wire/zstd_compressor.h"

#include <zstd.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace osteomill {

void ZstdCompressor::Free::operator()(ZSTD_CCtx_s* context) const {
    ZSTD_freeCCtx(context);
}

ZstdCompressor::ZstdCompressor(int level) : level_(level), context_(ZSTD_createCCtx()) {
    if (!context_) throw std::bad_alloc();
}

std::span<const std::uint8_t> ZstdCompressor::compress(std::span<const std::uint8_t> bytes) {
    compressed_.resize(std::max(compressed_.size(), ZSTD_compressBound(bytes.size())));
    const std::size_t size = ZSTD_compressCCtx(context_.get(), compressed_.data(), compressed_.size(),
                                               bytes.data(), bytes.size(), level_);
    if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
    return {compressed_.data(), size};
}

}  // namespace osteomill
