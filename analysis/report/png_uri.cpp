#include "analysis/report/png_uri.h"

#include <openssl/evp.h>
#include <png.h>

#include <cstring>
#include <stdexcept>

namespace osteomill {

std::string png_data_uri(const RgbPicture& picture) {
    png_image image;
    std::memset(&image, 0, sizeof image);
    image.version = PNG_IMAGE_VERSION;
    image.format = PNG_FORMAT_RGB;
    image.width = image.height = static_cast<png_uint_32>(picture.size_px);
    png_alloc_size_t bytes = 0;
    if (!png_image_write_to_memory(&image, nullptr, &bytes, 0, picture.rgb.data(), 0, nullptr))
        throw std::runtime_error(std::string("cannot make a PNG picture: ") + image.message);
    std::vector<unsigned char> png(bytes);
    if (!png_image_write_to_memory(&image, png.data(), &bytes, 0, picture.rgb.data(), 0, nullptr))
        throw std::runtime_error(std::string("cannot make a PNG picture: ") + image.message);
    std::vector<unsigned char> text(4 * ((bytes + 2) / 3) + 1);
    const int length = EVP_EncodeBlock(text.data(), png.data(), static_cast<int>(bytes));
    return "data:image/png;base64," + std::string(text.begin(), text.begin() + length);
}

}  // namespace osteomill
