#include "render_client/volume/picture.h"

#include <png.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/files/atomic_file.h"

namespace osteomill {

namespace {

png_image rgb_image() {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.format = PNG_FORMAT_RGB;
    return image;
}

void write(png_image& image, const glm::ivec2& size_px, const void* pixels, const void* colours,
           const std::filesystem::path& file) {
    image.width = static_cast<png_uint_32>(size_px.x);
    image.height = static_cast<png_uint_32>(size_px.y);
    AtomicFile whole(file, Link::replace);  // its name is ours
    errno = 0;
    if (!png_image_write_to_file(&image, whole.part().c_str(), 0, pixels, 0, colours)) {
        const int reason = errno;  // libpng does not know more about it
        throw std::runtime_error("cannot write the picture " + file.string() + ": " +
                                 (reason != 0 ? std::strerror(reason) : image.message));
    }
    whole.commit_unsynced();
}

/// Finishes an image whose reading has begun.
Picture finish_reading(png_image& image, bool has_begun, const std::string& name) {
    Picture picture({static_cast<int>(image.width), static_cast<int>(image.height)});
    image.format = PNG_FORMAT_RGB;
    if (!has_begun || !png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr))
        throw std::runtime_error("cannot read the picture " + name + ": " + image.message);
    return picture;
}

}  // namespace

void write_png(const Picture& picture, const std::filesystem::path& file) {
    png_image image = rgb_image();
    // A frame is written between two drawn ones: speed counts for more than size.
    image.flags = PNG_IMAGE_FLAG_FAST;
    write(image, picture.size_px, picture.rgb.data(), nullptr, file);
}

void write_indexed_png(const glm::ivec2& size_px, std::span<const std::uint8_t> indices,
                       std::span<const std::array<std::uint8_t, 3>> colours_rgb,
                       const std::filesystem::path& file) {
    png_image image = rgb_image();
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = static_cast<png_uint_32>(colours_rgb.size());
    write(image, size_px, indices.data(), colours_rgb.data(), file);
}

Picture read_png(const std::filesystem::path& file) {
    png_image image = rgb_image();
    const bool has_begun = png_image_begin_read_from_file(&image, file.c_str()) != 0;
    return finish_reading(image, has_begun, file.string());
}

Picture read_png(std::span<const std::uint8_t> bytes) {
    png_image image = rgb_image();
    const bool has_begun = png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) != 0;
    return finish_reading(image, has_begun, "in memory");
}

}  // namespace osteomill
