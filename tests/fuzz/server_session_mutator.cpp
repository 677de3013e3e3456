// Mutates a client's frames.
#include "osteomill/v2/session.pb.h"
#include "tests/fuzz/mutate_parts.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    using namespace osteomill;
    return fuzz::mutate_session<v2::ClientFrame>(data, size, most, seed, 1);
}
