#include "tests/support/synthetic_dicom.h"

#include <fmt/format.h>
#include <gdcmImageChangeTransferSyntax.h>
#include <gdcmImageReader.h>
#include <gdcmWriter.h>

#include <stdexcept>

namespace osteomill::testing {

namespace {

class DataSetWriter {
  public:
    explicit DataSetWriter(gdcm::DataSet& data) : data_(data) {}

    void text(std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, std::string value) {
        if (value.size() % 2 != 0) value.push_back(vr == gdcm::VR::UI ? '\0' : ' ');
        bytes(group, element, vr, value.data(), value.size());
    }
    void number(std::uint16_t group, std::uint16_t element, std::uint16_t value) {
        bytes(group, element, gdcm::VR::US, reinterpret_cast<const char*>(&value), sizeof value);
    }
    void bytes(std::uint16_t group, std::uint16_t element, gdcm::VR::VRType vr, const char* first,
               std::size_t count) {
        gdcm::DataElement entry(gdcm::Tag(group, element));
        entry.SetVR(vr);
        entry.SetByteValue(first, static_cast<std::uint32_t>(count));
        data_.Insert(entry);
    }

  private:
    gdcm::DataSet& data_;
};

std::string triple(const glm::dvec3& v) {
    return fmt::format("{:.9g}\\{:.9g}\\{:.9g}", v.x, v.y, v.z);
}

}  // namespace

void write_slice(const std::filesystem::path& file, const SyntheticSlice& slice) {
    constexpr const char* ct_image_storage = "1.2.840.10008.5.1.4.1.1.2";
    static_assert(sizeof(std::int16_t) == 2);
    const std::string instance =
        fmt::format("{}.{}", slice.series_uid, std::hash<std::string>{}(file.string()) % 1000000);
    gdcm::Writer writer;
    writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    DataSetWriter data(writer.GetFile().GetDataSet());
    data.text(0x0008, 0x0016, gdcm::VR::UI, ct_image_storage);
    data.text(0x0008, 0x0018, gdcm::VR::UI, instance);
    data.text(0x0008, 0x0060, gdcm::VR::CS, "CT");
    data.text(0x0020, 0x000d, gdcm::VR::UI, "1.2.826.0.1.3680043.2.1125");
    data.text(0x0020, 0x000e, gdcm::VR::UI, slice.series_uid);
    data.text(0x0020, 0x0032, gdcm::VR::DS, triple(slice.position_mm));
    data.text(0x0020, 0x0037, gdcm::VR::DS, triple(slice.along_row) + "\\" + triple(slice.along_column));
    data.number(0x0028, 0x0002, slice.samples_per_pixel);
    data.text(0x0028, 0x0004, gdcm::VR::CS, slice.samples_per_pixel == 1 ? "MONOCHROME2" : "RGB");
    if (!slice.frames.empty()) data.text(0x0028, 0x0008, gdcm::VR::IS, slice.frames);
    data.number(0x0028, 0x0010, slice.rows);
    data.number(0x0028, 0x0011, slice.columns);
    if (slice.with_pixel_spacing)
        data.text(0x0028, 0x0030, gdcm::VR::DS,
                  fmt::format("{:.9g}\\{:.9g}", slice.pixel_spacing_mm.x, slice.pixel_spacing_mm.y));
    data.number(0x0028, 0x0100, 16);
    data.number(0x0028, 0x0101, 16);
    data.number(0x0028, 0x0102, 15);
    data.number(0x0028, 0x0103, 1);
    data.text(0x0028, 0x1052, gdcm::VR::DS, fmt::format("{}", slice.intercept));
    data.text(0x0028, 0x1053, gdcm::VR::DS, fmt::format("{}", slice.slope));
    std::vector<std::int16_t> stored = slice.stored;
    stored.resize(static_cast<std::size_t>(slice.rows) * slice.columns * slice.samples_per_pixel *
                  (slice.frames.empty() ? 1u : std::stoul(slice.frames)));
    if (slice.with_pixel_data)
        data.bytes(0x7fe0, 0x0010, gdcm::VR::OW, reinterpret_cast<const char*>(stored.data()),
                   2 * stored.size());
    writer.SetFileName(file.c_str());
    if (!writer.Write()) throw std::runtime_error("cannot write " + file.string());
}

std::vector<SyntheticSlice> synthetic_series(int count) {
    std::vector<SyntheticSlice> slices;
    for (int i = 0; i < count; ++i) {
        SyntheticSlice slice;
        slice.position_mm = {-5.0, -4.0, 2.0 * i};
        slice.stored.assign(static_cast<std::size_t>(slice.rows) * slice.columns,
                            static_cast<std::int16_t>(1024 + 100 * i));
        slices.push_back(slice);
    }
    return slices;
}

void write_series(const std::filesystem::path& folder, const std::vector<SyntheticSlice>& slices) {
    std::filesystem::create_directories(folder);
    for (std::size_t i = 0; i < slices.size(); ++i)
        write_slice(folder / fmt::format("{:02}.dcm", i), slices[i]);
}

namespace {

void compress(const std::filesystem::path& from, const std::filesystem::path& to,
              const gdcm::TransferSyntax& syntax) {
    gdcm::ImageReader reader;
    reader.SetFileName(from.c_str());
    if (!reader.Read()) throw std::runtime_error("cannot read " + from.string());
    gdcm::ImageChangeTransferSyntax change;
    change.SetTransferSyntax(syntax);
    change.SetInput(reader.GetImage());
    if (!change.Change()) throw std::runtime_error("cannot compress " + from.string());
    // Not ImageWriter, which would state other positions of frames.
    gdcm::Writer writer;
    writer.SetFile(reader.GetFile());
    writer.GetFile().GetDataSet().Replace(
        static_cast<const gdcm::Bitmap&>(change.GetOutput()).GetDataElement());
    writer.GetFile().GetHeader().SetDataSetTransferSyntax(syntax);
    writer.SetFileName(to.c_str());
    if (!writer.Write()) throw std::runtime_error("cannot write " + to.string());
}

}  // namespace

void compress_as_jpeg2000(const std::filesystem::path& from, const std::filesystem::path& to) {
    compress(from, to, gdcm::TransferSyntax::JPEG2000Lossless);
}

void compress_as_rle(const std::filesystem::path& from, const std::filesystem::path& to) {
    compress(from, to, gdcm::TransferSyntax::RLELossless);
}

}  // namespace osteomill::testing
