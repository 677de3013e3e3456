// Mutates what a server sends; behind the four frames of the target's own session, if that is played first.
#include "osteomill/v1/session.pb.h"
#include "tests/fuzz/mutate_parts.h"

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
    using namespace osteomill;
    std::mt19937 random(seed);
    if (size < 2 || random() % 4 == 0) return LLVMFuzzerMutate(data, size, most);
    const char* const bytes = reinterpret_cast<const char*>(data);
    auto messages = fuzz::messages_of({bytes + 1, size - 1});
    fuzz::mutate_parts(messages, random);
    if (random() % 2 == 0) fuzz::renumber<v1::ServerFrame>(messages, data[0] % 2 == 1 ? 5 : 1);
    return fuzz::put(bytes[0] + fuzz::stream_of(messages), data, size, most);
}
