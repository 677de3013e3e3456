#include "haptic_server/imaging/dicom/dicom_frames.h"

#include <fmt/format.h>
#include <gdcmBoxRegion.h>
#include <gdcmImage.h>
#include <gdcmImageRegionReader.h>
#include <itkGDCMImageIO.h>
#include <itkImageFileReader.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <vector>

#include "haptic_server/imaging/dicom/quiet_libraries.h"
#include "haptic_server/imaging/formats/regular_file.h"
#include "haptic_server/imaging/imaging_error.h"

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

/// A copy in memory of a file whose header states the wrong sign of its pixels, with the right one.
class MendedFile {
  public:
    MendedFile(const std::filesystem::path& path, std::uint64_t sign_begin, bool is_signed)
        : descriptor_(::memfd_create("osteomill", MFD_CLOEXEC)) {
        const RegularFile file(path);
        std::vector<std::uint8_t> bytes = file.first_bytes(file.size());
        if (sign_begin + 2 > bytes.size()) throw ImagingError(path, "was cut off while it was read");
        // JPEG 2000 is little-endian.
        bytes[sign_begin] = is_signed ? 1 : 0;
        bytes[sign_begin + 1] = 0;
        for (std::size_t done = 0; done < bytes.size();) {
            const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
            if (count < 0) throw std::bad_alloc();
            done += static_cast<std::size_t>(count);
        }
    }
    ~MendedFile() { ::close(descriptor_); }
    MendedFile(const MendedFile&) = delete;
    MendedFile& operator=(const MendedFile&) = delete;

    std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  private:
    int descriptor_;
};

/// Only uncompressed pixels are found without reading those before them.
bool is_read_frame_by_frame(const DicomFile& file) {
    return file.header.frames.size() > 1 && file.header.is_uncompressed;
}

}  // namespace

class DicomFrames::Source {
  public:
    virtual ~Source() = default;
    virtual std::span<float> frame(unsigned index) = 0;
};

class DicomFrames::WholeFile : public Source {
  public:
    explicit WholeFile(const DicomFile& file) : file_(file) {}

    std::span<float> frame(unsigned index) override {
        if (!image_) image_ = decoded();
        const auto size = image_->GetBufferedRegion().GetSize();
        const std::size_t pixels = pixels_of_frame(file_);
        if (size[0] * size[1] != pixels || index >= size[2]) throw of_other_size(file_);
        return {image_->GetBufferPointer() + index * pixels, pixels};
    }

  private:
    using FloatImage = itk::Image<float, 3>;

    /// GDCM applies the file's own rescale slope and intercept.
    FloatImage::Pointer decoded() const {
        const DicomHeader& header = file_.header;
        std::optional<MendedFile> mended;
        if (header.wrong_sign_begin)
            mended.emplace(file_.path, *header.wrong_sign_begin, header.codestream_is_signed);
        try {
            const QuietLibraries quiet;
            const auto reader = itk::ImageFileReader<FloatImage>::New();
            reader->SetImageIO(itk::GDCMImageIO::New());
            reader->SetFileName(mended ? mended->name() : file_.path.string());
            reader->Update();
            return reader->GetOutput();
        } catch (const std::exception&) {
            throw undecodable(file_);
        }
    }

    DicomFile file_;
    FloatImage::Pointer image_;
};

class DicomFrames::FrameByFrame : public Source {
  public:
    explicit FrameByFrame(const DicomFile& file) : file_(file), values_(pixels_of_frame(file)) {
        reader_.SetFileName(file_.path.c_str());
        require([&] { return reader_.ReadInformation(); });
        const unsigned* size = reader_.GetImage().GetDimensions();
        if (size[0] != static_cast<unsigned>(file_.header.columns) ||
            size[1] != static_cast<unsigned>(file_.header.rows))
            throw of_other_size(file_);
    }

    std::span<float> frame(unsigned index) override {
        gdcm::BoxRegion region;
        region.SetDomain(0, static_cast<unsigned>(file_.header.columns) - 1, 0,
                         static_cast<unsigned>(file_.header.rows) - 1, index, index);
        reader_.SetRegion(region);
        stored_.resize(reader_.ComputeBufferLength());
        require([&] { return reader_.ReadIntoBuffer(stored_.data(), stored_.size()); });
        rescale();
        return values_;
    }

  private:
    /// GDCM says that it failed, or throws.
    template <typename Step>
    void require(const Step& step) const {
        const QuietLibraries quiet;
        bool is_done = false;
        try {
            is_done = step();
        } catch (const std::exception&) {
            is_done = false;
        }
        if (!is_done) throw undecodable(file_);
    }
    template <typename Stored>
    void rescale_from() {
        if (stored_.size() != values_.size() * sizeof(Stored)) throw of_other_size(file_);
        const double slope = reader_.GetImage().GetSlope();
        const double intercept = reader_.GetImage().GetIntercept();
        for (std::size_t i = 0; i < values_.size(); ++i) {
            Stored stored{};
            std::memcpy(&stored, stored_.data() + i * sizeof(Stored), sizeof(Stored));
            values_[i] = static_cast<float>(slope * static_cast<double>(stored) + intercept);
        }
    }
    void rescale() {
        switch (reader_.GetImage().GetPixelFormat().GetScalarType()) {
            case gdcm::PixelFormat::UINT8:
                return rescale_from<std::uint8_t>();
            case gdcm::PixelFormat::INT8:
                return rescale_from<std::int8_t>();
            case gdcm::PixelFormat::UINT16:
                return rescale_from<std::uint16_t>();
            case gdcm::PixelFormat::INT16:
                return rescale_from<std::int16_t>();
            case gdcm::PixelFormat::UINT32:
                return rescale_from<std::uint32_t>();
            case gdcm::PixelFormat::INT32:
                return rescale_from<std::int32_t>();
            default:
                throw undecodable(file_);
        }
    }

    DicomFile file_;
    gdcm::ImageRegionReader reader_;
    std::vector<char> stored_;
    std::vector<float> values_;
};

DicomFrames::DicomFrames(const DicomFile& file) {
    if (is_read_frame_by_frame(file))
        source_ = std::make_unique<FrameByFrame>(file);
    else
        source_ = std::make_unique<WholeFile>(file);
}

DicomFrames::~DicomFrames() = default;
DicomFrames::DicomFrames(DicomFrames&&) noexcept = default;
DicomFrames& DicomFrames::operator=(DicomFrames&&) noexcept = default;

std::span<float> DicomFrames::frame(unsigned index) {
    return source_->frame(index);
}

std::uint64_t DicomFrames::bytes_to_read(const DicomFile& file) {
    // As stored, rescaled, and as float.
    constexpr std::uint64_t bytes_of_a_pixel = 10;
    const std::uint64_t frame_bytes = bytes_of_a_pixel * pixels_of_frame(file);
    if (is_read_frame_by_frame(file)) return frame_bytes;
    return RegularFile(file.path).size() + file.header.frames.size() * frame_bytes;
}

}  // namespace osteomill
