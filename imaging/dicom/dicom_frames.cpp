#include "imaging/dicom/dicom_frames.h"

#include <fmt/format.h>
#include <gdcmAttribute.h>
#include <gdcmBoxRegion.h>
#include <gdcmImage.h>
#include <gdcmImageReader.h>
#include <gdcmImageRegionReader.h>
#include <gdcmMediaStorage.h>
#include <gdcmSequenceOfFragments.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/files/input_file.h"
#include "imaging/dicom/data_set.h"
#include "imaging/dicom/dicom_pixels.h"
#include "imaging/dicom/own_process.h"
#include "imaging/dicom/quiet_libraries.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

ImagingError undecodable(const DicomFile& file) {
    const std::string& syntax = file.header.transfer_syntax;
    return {file.path, fmt::format("its pixel data cannot be decoded ({}): cut off, damaged, or a codec "
                                   "that GDCM does not read",
                                   syntax.empty() ? "unknown transfer syntax" : syntax)};
}

ImagingError of_other_size(const DicomFile& file) {
    return {file.path, "its pixel data has not the size that its header says"};
}

std::size_t pixels_of_frame(const DicomFile& file) {
    return static_cast<std::size_t>(file.header.columns) * static_cast<std::size_t>(file.header.rows);
}

/// GDCM reads no pixels of private kinds, nor of kinds that are younger than GDCM. For labels it requires
/// colours.
bool is_known_kind(const DicomFile& file) {
    const DicomScan& scan = file.header.scan;
    if (is_segmentation(scan)) return false;
    return scan.sop_class.empty() ||
           gdcm::MediaStorage::IsImage(gdcm::MediaStorage::GetMSType(scan.sop_class.c_str()));
}

/// Takes pixels of any kind for those of a CT.
class AnyKindReader : public gdcm::ImageReader {
  public:
    bool read(const DicomFile& file) {
        const DicomScan& scan = file.header.scan;
        const auto fragments = scan.is_encapsulated ? fragments_of_frames(scan) : Fragments{};
        const bool is_apart = fragments.size() != scan.fragments.size();
        if (is_known_kind(file) && !is_apart) return Read();
        if (!gdcm::Reader::Read()) return false;
        forget_palette();
        if (is_apart && !join(fragments, scan.fragments.size())) return false;
        GetImage().SetTransferSyntax(GetFile().GetHeader().GetDataSetTransferSyntax());
        return ReadImage(gdcm::MediaStorage::CTImageStorage);
    }

  private:
    using Fragments = std::vector<std::vector<std::size_t>>;

    /// Most of its codecs take a fragment for a frame.
    bool join(const Fragments& fragments_of_frame, std::size_t expected) {
        gdcm::DataElement pixels = GetFile().GetDataSet().GetDataElement(gdcm::Tag(0x7fe0, 0x0010));
        const gdcm::SequenceOfFragments* apart = pixels.GetSequenceOfFragments();
        if (apart == nullptr || apart->GetNumberOfFragments() != expected) return false;
        const auto joined = gdcm::SequenceOfFragments::New();
        for (const std::vector<std::size_t>& fragments : fragments_of_frame) {
            std::string frame;
            for (const std::size_t fragment : fragments) {
                const gdcm::ByteValue* bytes = apart->GetFragment(fragment).GetByteValue();
                frame.append(bytes->GetPointer(), bytes->GetLength());
            }
            gdcm::Fragment whole;
            whole.SetByteValue(frame.data(), static_cast<std::uint32_t>(frame.size()));
            joined->AddFragment(whole);
        }
        pixels.SetValue(*joined);
        GetFile().GetDataSet().Replace(pixels);
        return true;
    }
    /// GDCM 3.0.21 ends the program if the palette's tables are missing or torn.
    void forget_palette() {
        using Photometric = gdcm::Attribute<0x0028, 0x0004>;
        if (text_of(GetFile().GetDataSet(), Photometric::GetTag()) != "PALETTE COLOR") return;
        Photometric grey;
        grey.SetValue("MONOCHROME2 ");
        GetFile().GetDataSet().Replace(grey.GetAsDataElement());
    }
};

constexpr std::string_view rle = "1.2.840.10008.1.2.5";  ///< the one compression that codes bytes, not pixels

/// Whether GDCM would take others for a pixel's bits than the header says, or fail: it takes the lowest of
/// those that are there, and fewer than all of 16 alone.
bool lies_elsewhere(const DicomFile& file) {
    const DicomScan& scan = file.header.scan;
    const bool keeps_bits = !scan.is_encapsulated || scan.transfer_syntax == rle;
    return keeps_bits && scan.high_bit && scan.bits_stored && scan.bits_allocated &&
           *scan.high_bit < *scan.bits_allocated &&
           (*scan.high_bit + 1 > *scan.bits_stored ||
            (*scan.bits_allocated != 16 && *scan.bits_stored < *scan.bits_allocated));
}

/// GDCM treats them as the lowest, and would clear the others.
void keep_all_bits(gdcm::ImageReader& reader) {
    gdcm::PixelFormat format = reader.GetImage().GetPixelFormat();
    const auto bits = format.GetBitsAllocated();
    format.SetBitsStored(bits);
    format.SetHighBit(static_cast<unsigned short>(bits - 1));
    reader.GetImage().SetPixelFormat(format);
    // If GDCM reads only some of the pixels, it takes these numbers from the file.
    const auto replace = [&](std::uint16_t element, unsigned short value) {
        gdcm::Attribute<0x0028, 0x0101> number;
        number.SetValue(value);
        gdcm::DataElement replaced = number.GetAsDataElement();
        replaced.SetTag({0x0028, element});
        reader.GetFile().GetDataSet().Replace(replaced);
    };
    replace(0x0101, bits);
    replace(0x0102, static_cast<unsigned short>(bits - 1));
}

/// Only uncompressed pixels are found without reading those before them.
bool is_read_frame_by_frame(const DicomFile& file) {
    return file.header.is_uncompressed && is_known_kind(file);
}

/// GDCM says that it failed, or throws.
template <typename Step>
void require(const DicomFile& file, const Step& step) {
    if (!quietly(step)) throw undecodable(file);
}

}  // namespace

/// Gives a frame's pixels as they are stored, in the machine's byte order.
class DicomFrames::Source {
  public:
    virtual ~Source() = default;
    virtual std::span<const char> stored(unsigned index) = 0;
    virtual gdcm::PixelFormat format() const = 0;
};

/// Decoded apart: over some damaged pixels GDCM's codecs end their process.
class DicomFrames::AtomicFile : public Source {
  public:
    explicit AtomicFile(const DicomFile& file) : shared_(sizeof(Decoded) + most_bytes(file)) {
        const std::span<char> pixels = shared_.bytes().subspan(sizeof(Decoded));
        const auto decode = [&] {
            AnyKindReader reader;
            reader.SetFileName(file.path.c_str());
            if (!reader.read(file)) return false;
            gdcm::Image& image = reader.GetImage();
            if (file.header.sign_of_codestream) {
                gdcm::PixelFormat format = image.GetPixelFormat();
                format.SetPixelRepresentation(*file.header.sign_of_codestream ? 1 : 0);
                image.SetPixelFormat(format);
            }
            if (lies_elsewhere(file)) keep_all_bits(reader);
            const unsigned* size = image.GetDimensions();
            const Decoded decoded{.format = image.GetPixelFormat(),
                                  .columns = size[0],
                                  .rows = size[1],
                                  .frames = image.GetNumberOfDimensions() > 2 ? size[2] : 1,
                                  .bytes = image.GetBufferLength()};
            std::memcpy(shared_.bytes().data(), &decoded, sizeof decoded);
            return decoded.bytes > pixels.size() || image.GetBuffer(pixels.data());
        };
        if (!succeeds_apart(decode)) throw undecodable(file);
        std::memcpy(&decoded_, shared_.bytes().data(), sizeof decoded_);
        if (std::size_t{decoded_.columns} * decoded_.rows != pixels_of_frame(file) ||
            decoded_.bytes > pixels.size() || decoded_.frames == 0)
            throw of_other_size(file);
    }

    std::span<const char> stored(unsigned index) override {
        const std::size_t bytes = decoded_.bytes / decoded_.frames;
        if (index >= decoded_.frames) return {};
        return shared_.bytes().subspan(sizeof(Decoded) + index * bytes, bytes);
    }
    gdcm::PixelFormat format() const override { return decoded_.format; }

  private:
    struct Decoded {
        gdcm::PixelFormat format;
        unsigned columns = 0, rows = 0, frames = 0;
        std::size_t bytes = 0;
    };
    static_assert(std::is_trivially_copyable_v<Decoded>);

    static std::size_t most_bytes(const DicomFile& file) {
        const DicomScan& scan = file.header.scan;
        const auto bits = static_cast<std::size_t>(std::max(scan.bits_allocated.value_or(0), 8));
        return frame_count(scan) * pixels_of_frame(file) *
               static_cast<std::size_t>(scan.samples_per_pixel.value_or(1)) * bits / 8;
    }

    SharedBytes shared_;
    Decoded decoded_;
};

class DicomFrames::FrameByFrame : public Source {
  public:
    explicit FrameByFrame(const DicomFile& file) : file_(file) {
        reader_.SetFileName(file_.path.c_str());
        require(file_, [&] { return reader_.ReadInformation(); });
        if (lies_elsewhere(file_)) keep_all_bits(reader_);
        const unsigned* size = reader_.GetImage().GetDimensions();
        if (size[0] != static_cast<unsigned>(file_.header.columns) ||
            size[1] != static_cast<unsigned>(file_.header.rows))
            throw of_other_size(file_);
    }

    std::span<const char> stored(unsigned index) override {
        gdcm::BoxRegion region;
        region.SetDomain(0, static_cast<unsigned>(file_.header.columns) - 1, 0,
                         static_cast<unsigned>(file_.header.rows) - 1, index, index);
        reader_.SetRegion(region);
        stored_.resize(reader_.ComputeBufferLength());
        require(file_, [&] { return reader_.ReadIntoBuffer(stored_.data(), stored_.size()); });
        return stored_;
    }
    gdcm::PixelFormat format() const override { return reader_.GetImage().GetPixelFormat(); }

  private:
    DicomFile file_;
    gdcm::ImageRegionReader reader_;
    std::vector<char> stored_;
};

namespace {

/// The bits that hold the pixel. Old scanners keep overlays in the other bits.
template <typename Stored>
Stored pixel_of(Stored raw, unsigned shift, unsigned bits) {
    if (bits >= 8 * sizeof(Stored)) return raw;
    using Unsigned = std::make_unsigned_t<Stored>;
    const auto to_top = static_cast<unsigned>(8 * sizeof(Stored) - bits);
    const auto moved = static_cast<Unsigned>(static_cast<Unsigned>(raw) << (to_top - shift));
    return static_cast<Stored>(static_cast<Stored>(moved) >> to_top);  // with its sign
}

struct PixelBits {
    unsigned stored = 0;
    unsigned high = 0;  ///< the highest of them
};

template <typename Stored>
void to_hu(std::span<const char> bytes, const PixelBits& bits, const DicomValues& values,
           const DicomRescale& rescale, std::span<float> hu) {
    const unsigned shift = bits.high + 1U >= bits.stored ? bits.high + 1U - bits.stored : 0U;
    for (std::size_t i = 0; i < hu.size(); ++i) {
        Stored raw{};
        std::memcpy(&raw, bytes.data() + i * sizeof(Stored), sizeof(Stored));
        const auto stored = static_cast<std::int64_t>(pixel_of(raw, shift, bits.stored));
        hu[i] = values.hu(stored, rescale);
    }
}

}  // namespace

DicomFrames::DicomFrames(const DicomFile& file) : file_(file), values_(pixels_of_frame(file)) {
    if (is_read_frame_by_frame(file))
        source_ = std::make_unique<FrameByFrame>(file);
    else
        source_ = std::make_unique<AtomicFile>(file);
}

DicomFrames::~DicomFrames() = default;
DicomFrames::DicomFrames(DicomFrames&&) noexcept = default;
DicomFrames& DicomFrames::operator=(DicomFrames&&) noexcept = default;

std::span<float> DicomFrames::frame(unsigned index) {
    const std::span<const char> stored = source_->stored(index);
    const gdcm::PixelFormat format = source_->format();
    const DicomHeader& header = file_.header;
    if (stored.size() != values_.size() * format.GetPixelSize() || index >= header.rescales.size())
        throw of_other_size(file_);
    const PixelBits bits = lies_elsewhere(file_) ? PixelBits{static_cast<unsigned>(*header.scan.bits_stored),
                                                             static_cast<unsigned>(*header.scan.high_bit)}
                                                 : PixelBits{format.GetBitsStored(), format.GetHighBit()};
    const auto convert = [&]<typename Stored>(Stored) {
        to_hu<Stored>(stored, bits, header.values, header.rescales[index], values_);
    };
    switch (format.GetScalarType()) {
        case gdcm::PixelFormat::UINT8:
            convert(std::uint8_t{});
            break;
        case gdcm::PixelFormat::INT8:
            convert(std::int8_t{});
            break;
        case gdcm::PixelFormat::UINT12:
        case gdcm::PixelFormat::UINT16:
            convert(std::uint16_t{});
            break;
        case gdcm::PixelFormat::INT12:
        case gdcm::PixelFormat::INT16:
            convert(std::int16_t{});
            break;
        case gdcm::PixelFormat::UINT32:
            convert(std::uint32_t{});
            break;
        case gdcm::PixelFormat::INT32:
            convert(std::int32_t{});
            break;
        default:
            throw undecodable(file_);
    }
    return values_;
}

std::uint64_t DicomFrames::bytes_to_read(const DicomFile& file) {
    // A pixel is held as stored, rescaled, and as float.
    constexpr std::uint64_t bytes_of_a_pixel = 10;
    const std::uint64_t frame_bytes = bytes_of_a_pixel * pixels_of_frame(file);
    if (is_read_frame_by_frame(file)) return frame_bytes;
    return InputFile(file.path).size() + file.header.frames.size() * frame_bytes;
}

}  // namespace osteomill
