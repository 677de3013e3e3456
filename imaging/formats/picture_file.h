// One picture, PNG or a page of a TIFF.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "imaging/formats/source_image.h"

struct tiff;  // libtiff's

namespace osteomill {

struct SlicePicture {
    int width = 0;
    int height = 0;
    bool is_coloured = false;
    std::vector<float> values{};  ///< left to right, top to bottom; see picture_stack.h
    std::string note{};           ///< how values were converted; empty if they were not
};

/// PNG of any form: grey stays grey, 8 or 16 bits, palettes are colours. Throws ImagingError.
SlicePicture read_png_slice(const std::filesystem::path& path);

/// A TIFF whose pages are slices. It stays open: a page is found from the one before, else from the first.
class TiffPages {
  public:
    /// Throws ImagingError.
    explicit TiffPages(const std::filesystem::path& path);

    /// Throws ImagingError if ImageJ or OME say that not each of them is a slice.
    int count() const;
    /// Grey of 8, 16 or 32 bits or floats; colours of 8 bits. A scan's white may be 0, and ImageJ's linear
    /// calibration of levels is applied to it; labels are read as stored. Throws ImagingError.
    SlicePicture read(int page, ImagePurpose purpose);

  private:
    std::filesystem::path path_;
    std::unique_ptr<::tiff, void (*)(::tiff*)> file_;
    std::string description_;  // the first page's
};

}  // namespace osteomill
