#include "imaging/bone_file/digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <span>
#include <string_view>
#include <vector>

#include "common/files/input_file.h"
#include "imaging/formats/nrrd_header.h"
#include "imaging/imaging_error.h"

namespace osteomill {

Digest::Digest() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
}

void Digest::add(std::span<const std::byte> bytes) {
    XXH3_128bits_update(state_.get(), bytes.data(), bytes.size());
}

std::string Digest::text() const {
    const XXH128_hash_t hash = XXH3_128bits_digest(state_.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

bool has_file_digest(const std::filesystem::path& path) {
    constexpr std::size_t piece_bytes = 1U << 20U;
    const InputFile file(path);
    std::vector<std::uint8_t> bytes = file.first_bytes(most_nrrd_header_bytes);
    if (!std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()).starts_with("NRRD"))
        return false;
    const NrrdHeader header = parse_nrrd_header(bytes, path);
    const auto said = header.key_values.find(file_digest_key);
    if (said == header.key_values.end()) return false;

    std::string text(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header.bytes));
    const std::string line = fmt::format("\n{}:={}\n", file_digest_key, said->second);
    const std::size_t at = text.find(line);
    if (at != std::string::npos && said->second.size() == Digest::text_length)
        text.replace(at + line.size() - 1 - Digest::text_length, Digest::text_length, no_digest_yet());
    Digest digest;
    bytes.resize(piece_bytes);
    for (std::uint64_t done = header.bytes; done < file.size();) {
        const std::size_t read = file.read_at(done, std::as_writable_bytes(std::span(bytes)));
        if (read == 0) break;
        digest.add(std::as_bytes(std::span(bytes).first(read)));
        done += read;
    }
    digest.add(std::as_bytes(std::span(text)));
    if (digest.text() == said->second) return true;
    throw ImagingError(path,
                       fmt::format("is damaged: its digest is {}, not the {} that was written (where it was "
                                   "changed on purpose, take the line {} out of its header)",
                                   digest.text(), said->second, file_digest_key));
}

}  // namespace osteomill
