// One picture, PNG or a page of a TIFF.
#pragma once

#include <filesystem>
#include <vector>

namespace osteomill {

struct SlicePicture {
    int width = 0;
    int height = 0;
    bool is_coloured = false;
    std::vector<float> values{};  ///< left to right, top to bottom; see picture_stack.h
};

/// PNG of any form: grey stays grey, 8 or 16 bits, palettes are colours. Throws ImagingError.
SlicePicture read_png_slice(const std::filesystem::path& path);

/// A page of a TIFF: grey of 8, 16 or 32 bits or floats; colours of 8 bits. Throws ImagingError.
SlicePicture read_tiff_slice(const std::filesystem::path& path, int page);
int tiff_pages(const std::filesystem::path& path);

}  // namespace osteomill
