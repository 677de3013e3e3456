// Mutates a server's frames, behind the four frames of the target's own session if that is played first.
#include "osteomill/v2/session.pb.h"
#include "tests/fuzz/mutate_parts.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    using namespace osteomill;
    const bool plays_its_own_first = size > 0 && data[0] % 2 == 1;
    return fuzz::mutate_session<v2::ServerFrame>(data, size, most, seed, plays_its_own_first ? 5 : 1);
}
