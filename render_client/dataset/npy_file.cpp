#include "render_client/dataset/npy_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <glm/gtc/packing.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/files/atomic_file.h"

namespace osteomill {

namespace {

static_assert(std::endian::native == std::endian::little);

std::string header_of(std::string_view type, const std::string& shape) {
    constexpr std::size_t before_text = 10, alignment = 64;
    std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
    text.append(alignment - 1 - (before_text + text.size()) % alignment, ' ');
    text += '\n';
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(text.size() & 0xff);
    header += static_cast<char>(text.size() >> 8);
    return header + text;
}

void write(const std::string& header, std::span<const std::byte> numbers, const std::filesystem::path& file) {
    AtomicFile whole(file, Link::replace);  // its name is ours
    whole.write(std::as_bytes(std::span(header)));
    whole.write(numbers);
    whole.commit_unsynced();
}

void require_as_many(const glm::ivec2& size_px, std::size_t count) {
    if (static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y) != count)
        throw std::invalid_argument(fmt::format("{} values for {} x {} pixels", count, size_px.x, size_px.y));
}

}  // namespace

void write_npy(const glm::ivec2& size_px, std::span<const float> values, const std::filesystem::path& file) {
    require_as_many(size_px, values.size());
    write(header_of("<f4", fmt::format("{}, {}", size_px.y, size_px.x)), std::as_bytes(values), file);
}

std::vector<std::uint16_t> halves_of(std::span<const glm::vec3> values) {
    std::vector<std::uint16_t> halves;
    halves.reserve(3 * values.size());
    for (const glm::vec3& value : values)
        for (int axis = 0; axis < 3; ++axis) halves.push_back(glm::packHalf1x16(value[axis]));
    return halves;
}

void write_npy(const glm::ivec2& size_px, std::span<const glm::vec3> values,
               const std::filesystem::path& file) {
    require_as_many(size_px, values.size());
    const std::vector<std::uint16_t> halves = halves_of(values);
    write(header_of("<f2", fmt::format("{}, {}, 3", size_px.y, size_px.x)), std::as_bytes(std::span(halves)),
          file);
}

}  // namespace osteomill
