#include "imaging/picture/rgb_png.h"

#include <fmt/format.h>
#include <png.h>

#include <stdexcept>

namespace osteomill {

void write_rgb_png(std::span<const std::uint8_t> rgb, const glm::ivec2& size_px,
                   const std::filesystem::path& path, Link link) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.format = PNG_FORMAT_RGB;
    image.width = static_cast<png_uint_32>(size_px.x);
    image.height = static_cast<png_uint_32>(size_px.y);
    AtomicFile file(path, link);
    if (!png_image_write_to_file(&image, file.part().c_str(), 0, rgb.data(), 0, nullptr))
        throw std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), image.message));
    file.commit();
}

}  // namespace osteomill
