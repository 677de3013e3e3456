// Pictures as tests write them: PNG and TIFF.
#pragma once

#include <png.h>
#include <tiffio.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace osteomill::testing {

/// `format`: PNG_FORMAT_RGBA or PNG_FORMAT_GRAY, of 8 bits.
inline void write_png_picture(const std::filesystem::path& path, int width, int height, std::uint32_t format,
                              const std::vector<std::uint8_t>& bytes) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = format;
    if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) == 0)
        throw std::runtime_error("cannot write " + path.string());
}

struct TiffTags {
    int orientation = ORIENTATION_TOPLEFT;
    int photometric = PHOTOMETRIC_MINISBLACK;
    const char* description = "";
};

/// Grey, a page for each, `bits` of 8 or 16.
template <typename Sample>
void write_tiff_pages(const std::filesystem::path& path, int width, int height,
                      const std::vector<std::vector<Sample>>& pages, const TiffTags& tags = {}) {
    TIFF* tiff = TIFFOpen(path.c_str(), "w");
    if (tiff == nullptr) throw std::runtime_error("cannot write " + path.string());
    for (const std::vector<Sample>& page : pages) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, int{8 * sizeof(Sample)});
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, tags.photometric);
        TIFFSetField(tiff, TIFFTAG_ORIENTATION, tags.orientation);
        if (*tags.description != '\0') TIFFSetField(tiff, TIFFTAG_IMAGEDESCRIPTION, tags.description);
        TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_LZW);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 3);
        for (int y = 0; y < height; ++y)
            TIFFWriteScanline(tiff, const_cast<Sample*>(&page[static_cast<std::size_t>(y * width)]),
                              static_cast<std::uint32_t>(y), 0);
        TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
}

}  // namespace osteomill::testing
