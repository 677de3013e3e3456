#include "imaging/formats/picture_file.h"

#include <fmt/format.h>
#include <png.h>
#include <tiffio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "common/files/input_file.h"
#include "common/text/words.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28U;

void require_size(const std::filesystem::path& path, std::uint64_t width, std::uint64_t height) {
    if (width == 0 || height == 0 || width > 65536 || height > 65536 || width * height > most_pixels)
        throw ImagingError(
            path, fmt::format("is a picture of {} x {}; a slice has at most 2^28 pixels", width, height));
}

float packed(std::uint8_t red, std::uint8_t green, std::uint8_t blue, std::uint8_t alpha) {
    return alpha == 0 ? 0.0F : static_cast<float>(red << 16 | green << 8 | blue);
}

/// The picture as libpng gives it: grey of 8 or 16 bits (of this machine's order), or RGBA of 8.
struct PngRows {
    std::uint32_t width = 0, height = 0;
    int bits = 0;
    bool is_coloured = false;
    std::vector<png_byte> bytes{};
    std::vector<png_bytep> rows{};
    std::string message{};
};

void note_png_error(png_structp png, png_const_charp message) {
    *static_cast<std::string*>(png_get_error_ptr(png)) = message;
    longjmp(png_jmpbuf(png), 1);
}

/// Nothing with a destructor lives here: libpng leaves by longjmp. False if it did.
bool decode_png(png_structp png, png_infop info, std::FILE* file, PngRows& out, bool headers_only) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    if (headers_only) {
        png_init_io(png, file);
        png_read_info(png, info);
        const int form = png_get_color_type(png, info);
        out.width = png_get_image_width(png, info);
        out.height = png_get_image_height(png, info);
        out.is_coloured = (form & PNG_COLOR_MASK_COLOR) != 0;
        out.bits = !out.is_coloured && png_get_bit_depth(png, info) == 16 ? 16 : 8;
        return true;
    }
    png_set_expand(png);
    if (out.is_coloured) {
        png_set_strip_16(png);
        png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
    } else {
        png_set_strip_alpha(png);
        const std::uint16_t one = 1;
        if (*reinterpret_cast<const std::uint8_t*>(&one) == 1 && out.bits == 16) png_set_swap(png);
    }
    (void)png_set_interlace_handling(png);
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) * out.height != out.bytes.size())
        png_error(png, "its rows have another length than its header says");
    png_read_image(png, out.rows.data());
    return true;
}

TIFF* open_tiff(const std::filesystem::path& path) {
    { const InputFile is_one(path); }
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    TIFF* file = TIFFOpen(path.c_str(), "rm");
    if (file == nullptr)
        throw ImagingError(path, "cannot be read as TIFF: it does not exist, or its header is damaged");
    return file;
}

/// The number of "key=8" in ImageJ's description of a stack, or of `SizeC="8"` in OME's; NaN if there is
/// none.
double stated(const std::string& description, const std::string& key) {
    std::size_t at = description.find(key);
    while (at != std::string::npos && at > 0 && std::isalnum(static_cast<unsigned char>(description[at - 1])))
        at = description.find(key, at + 1);
    if (at == std::string::npos) return std::nan("");
    at += key.size();
    return real_number(description.substr(at, description.find_first_of("\r\n\"", at) - at))
        .value_or(std::nan(""));
}

/// The description of a TIFF's first page, at which it is open.
std::string description_of(TIFF* tiff) {
    const char* text = nullptr;
    return TIFFGetField(tiff, TIFFTAG_IMAGEDESCRIPTION, &text) == 1 && text != nullptr ? text : "";
}

/// The straight line by which ImageJ makes its levels of the stored ones; it keeps signed numbers so.
void calibrate(const std::filesystem::path& path, const std::string& description, SlicePicture& picture) {
    if (!description.starts_with("ImageJ=") || stated(description, "cf=") > 0.0) return;  // another curve
    const double offset = stated(description, "c0=");
    const double slope = stated(description, "c1=");
    if (!std::isfinite(offset) || !std::isfinite(slope) || slope == 0.0) return;
    for (float& value : picture.values)
        value = static_cast<float>(offset + slope * static_cast<double>(value));
    picture.note = fmt::format("{}: ImageJ calibrates its levels: {} x level + {}; applied", path.string(),
                               slope, offset);
}

/// Turns a picture the right way up, which is stored from another corner.
void turn(SlicePicture& picture, std::uint16_t orientation) {
    const auto width = static_cast<std::ptrdiff_t>(picture.width);
    if (orientation == ORIENTATION_BOTRIGHT || orientation == ORIENTATION_BOTLEFT)
        std::ranges::reverse(picture.values);
    if (orientation == ORIENTATION_TOPRIGHT || orientation == ORIENTATION_BOTLEFT)
        for (auto row = picture.values.begin(); row != picture.values.end(); row += width)
            std::reverse(row, row + width);
}

template <typename Sample>
void add_samples(const std::vector<std::uint8_t>& line, std::size_t count, bool is_inverted,
                 std::vector<float>& values) {
    for (std::size_t i = 0; i < count; ++i) {
        Sample sample{};
        std::memcpy(&sample, &line[i * sizeof sample], sizeof sample);
        const auto value = static_cast<float>(sample);
        values.push_back(is_inverted ? static_cast<float>(std::numeric_limits<Sample>::max()) - value
                                     : value);
    }
}

}  // namespace

SlicePicture read_png_slice(const std::filesystem::path& path) {
    { const InputFile is_one(path); }
    constexpr auto close = [](std::FILE* opened) { std::fclose(opened); };
    const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"));
    if (!file) throw ImagingError(path, "cannot be opened");
    PngRows rows;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &rows.message, note_png_error,
                                             [](png_structp, png_const_charp) {});
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const auto free_png = [&](void*) { png_destroy_read_struct(&png, &info, nullptr); };
    const std::unique_ptr<void, decltype(free_png)> guard(&rows, free_png);
    if (info == nullptr) throw std::bad_alloc();
    bool is_read = decode_png(png, info, file.get(), rows, true);
    if (is_read) {
        require_size(path, rows.width, rows.height);
        const std::size_t row_bytes =
            std::size_t{rows.width} * (rows.is_coloured ? 4U : static_cast<unsigned>(rows.bits) / 8U);
        rows.bytes.resize(row_bytes * rows.height);
        for (std::size_t y = 0; y < rows.height; ++y) rows.rows.push_back(rows.bytes.data() + y * row_bytes);
        is_read = decode_png(png, info, file.get(), rows, false);
    }
    if (!is_read) throw ImagingError(path, fmt::format("cannot be read as PNG: {}", rows.message));
    SlicePicture picture{.width = static_cast<int>(rows.width),
                         .height = static_cast<int>(rows.height),
                         .is_coloured = rows.is_coloured};
    const std::size_t pixels = std::size_t{rows.width} * rows.height;
    picture.values.reserve(pixels);
    for (std::size_t i = 0; i < pixels && rows.is_coloured; ++i) {
        const png_byte* rgba = &rows.bytes[4 * i];
        picture.values.push_back(packed(rgba[0], rgba[1], rgba[2], rgba[3]));
    }
    if (!rows.is_coloured && rows.bits == 16)
        add_samples<std::uint16_t>(rows.bytes, pixels, false, picture.values);
    if (!rows.is_coloured && rows.bits == 8) picture.values.assign(rows.bytes.begin(), rows.bytes.end());
    return picture;
}

TiffPages::TiffPages(const std::filesystem::path& path)
    : path_(path), file_(open_tiff(path), &TIFFClose), description_(description_of(file_.get())) {}

int TiffPages::count() const {
    const int pages = TIFFNumberOfDirectories(file_.get());
    for (const auto& [key, name] : {std::pair{"channels=", "channels"}, std::pair{"frames=", "times"},
                                    std::pair{"SizeC=\"", "channels"}, std::pair{"SizeT=\"", "times"}})
        if (const double count = stated(description_, key); count > 1.0 && count < pages)
            throw ImagingError(path_, fmt::format("its {} pages are of {} {}; save one of them as a stack",
                                                  pages, count, name));
    if (const double images = stated(description_, "images="); images > 1.0 && pages == 1)
        throw ImagingError(path_,
                           fmt::format("says that it holds {} slices and has one page, as ImageJ saves "
                                       "large stacks; save it as a sequence of pictures",
                                       images));
    return pages;
}

SlicePicture TiffPages::read(int page, ImagePurpose purpose) {
    TIFF* tiff = file_.get();
    const std::filesystem::path& path = path_;
    const auto damaged = [&] {
        return ImagingError(path,
                            fmt::format("page {}: cannot be read as TIFF: cut off or damaged", page + 1));
    };
    const auto wanted = static_cast<tdir_t>(page);
    if (wanted == TIFFCurrentDirectory(tiff) + 1 ? TIFFReadDirectory(tiff) == 0
                                                 : TIFFSetDirectory(tiff, wanted) == 0)
        throw damaged();
    std::uint32_t width = 0, height = 0;
    std::uint16_t bits = 1, samples = 1, photometric = PHOTOMETRIC_MINISBLACK, format = SAMPLEFORMAT_UINT;
    TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &height);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
    TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    if (orientation < ORIENTATION_TOPLEFT || orientation > ORIENTATION_BOTLEFT)
        throw ImagingError(path, fmt::format("page {}: its rows and columns are exchanged (Orientation {}); "
                                             "save it upright",
                                             page + 1, orientation));
    require_size(path, width, height);
    SlicePicture picture{.width = static_cast<int>(width), .height = static_cast<int>(height)};
    picture.values.reserve(std::size_t{width} * height);
    picture.is_coloured = photometric != PHOTOMETRIC_MINISBLACK && photometric != PHOTOMETRIC_MINISWHITE;
    if (picture.is_coloured) {
        std::vector<std::uint32_t> rgba(std::size_t{width} * height);
        if (TIFFReadRGBAImageOriented(tiff, width, height, rgba.data(), ORIENTATION_TOPLEFT, 1) == 0)
            throw damaged();
        for (const std::uint32_t pixel : rgba)
            picture.values.push_back(
                TIFFGetA(pixel) == 0
                    ? 0.0F
                    : static_cast<float>(TIFFGetR(pixel) << 16U | TIFFGetG(pixel) << 8U | TIFFGetB(pixel)));
        return picture;
    }
    const bool is_float = format == SAMPLEFORMAT_IEEEFP;
    if (samples != 1 || TIFFIsTiled(tiff) != 0 ||
        (is_float ? bits != 32 : bits != 8 && bits != 16 && bits != 32))
        throw ImagingError(path,
                           fmt::format("page {}: grey of {} bits and {} samples a pixel{} is not read; save "
                                       "it as 8 or 16 bits in strips",
                                       page + 1, bits, samples, TIFFIsTiled(tiff) != 0 ? ", in tiles," : ""));
    const bool is_signed = format == SAMPLEFORMAT_INT;
    const bool is_inverted = photometric == PHOTOMETRIC_MINISWHITE && purpose == ImagePurpose::scan;
    if (is_inverted && (is_float || is_signed || bits > 16))
        throw ImagingError(path,
                           fmt::format("page {}: 0 is white (Photometric Interpretation 0) among numbers "
                                       "that have no highest one; save it with black as 0",
                                       page + 1));
    std::vector<std::uint8_t> line(static_cast<std::size_t>(TIFFScanlineSize(tiff)));
    if (line.size() < std::size_t{width} * bits / 8) throw damaged();
    for (std::uint32_t y = 0; y < height; ++y) {
        if (TIFFReadScanline(tiff, line.data(), y, 0) != 1) throw damaged();
        if (is_float)
            add_samples<float>(line, width, false, picture.values);
        else if (bits == 8)
            is_signed ? add_samples<std::int8_t>(line, width, false, picture.values)
                      : add_samples<std::uint8_t>(line, width, is_inverted, picture.values);
        else if (bits == 16)
            is_signed ? add_samples<std::int16_t>(line, width, false, picture.values)
                      : add_samples<std::uint16_t>(line, width, is_inverted, picture.values);
        else
            is_signed ? add_samples<std::int32_t>(line, width, false, picture.values)
                      : add_samples<std::uint32_t>(line, width, false, picture.values);
    }
    turn(picture, orientation);
    if (purpose == ImagePurpose::scan) calibrate(path, description_, picture);
    return picture;
}

}  // namespace osteomill
