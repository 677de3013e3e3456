#include "imaging/dicom/dicom_segmentation.h"

#include <fmt/format.h>
#include <gdcmReader.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>

#include "common/files/input_file.h"
#include "imaging/dicom/data_set.h"
#include "imaging/dicom/dicom_scan.h"
#include "imaging/dicom/quiet_libraries.h"
#include "imaging/formats/plausible_geometry.h"
#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

using gdcm::DataSet;
using gdcm::Tag;

constexpr std::uint64_t most_segmentation_bytes = std::uint64_t{1} << 30U;
constexpr std::uint64_t most_segmentation_voxels = std::uint64_t{1} << 31U;
constexpr int most_layers_of_segments = 255;
/// Positions are printed; a slice lies where it is within this share of the gap.
constexpr double slice_tolerance = 0.02;

/// One layer of labels, x fastest; a segment of frames that overlap others lies in another.
using Layer = std::vector<std::uint16_t>;

struct SegmentFrame {
    int segment = 0;  ///< 0: of a label map, whose pixels are segments
    glm::dvec3 position_mm{0.0};
};

/// The segments' frames, and what they hold.
class SegmentationSource {
  public:
    explicit SegmentationSource(const std::filesystem::path& path) : path_(path) {
        const InputFile file(path);
        if (file.size() > most_segmentation_bytes)
            throw ImagingError(path, "is a segmentation of more than 1 GiB");
        try {
            scan_ = scan_dicom(file.first_bytes(file.size()), file.size());
        } catch (const std::invalid_argument& error) {
            throw ImagingError(path, error.what());
        }
        const QuietLibraries quiet;
        reader_.SetFileName(path.c_str());
        bool is_read = false;
        try {
            is_read = reader_.Read();
        } catch (const std::exception&) {
            is_read = false;
        }
        if (!is_read || !scan_) throw ImagingError(path, "is DICOM but cannot be parsed: cut off or damaged");
        read_sizes();
        read_frames();
    }

    OpenedImage open() {
        OpenedImage opened;
        opened.image = placed_image();
        std::vector<Layer> layers = filled(opened.image);
        name_segments(opened);
        opened.layers = static_cast<int>(layers.size());
        opened.reading_bytes = layers.size() * sizeof(std::uint16_t) * voxel_count(opened.image);
        opened.read_slices = [size = opened.image.size_voxels,
                              held = std::make_shared<const std::vector<Layer>>(std::move(layers))](
                                 const TakeSlice& take, const ReportProgress& report) {
            const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
            std::vector<float> slice(pixels * held->size());
            for (int k = 0; k < size.z; ++k) {
                for (std::size_t layer = 0; layer < held->size(); ++layer)
                    for (std::size_t i = 0; i < pixels; ++i)
                        slice[i * held->size() + layer] =
                            (*held)[layer][static_cast<std::size_t>(k) * pixels + i];
                take(k, slice);
                report(static_cast<double>(k + 1) / size.z);
            }
        };
        return opened;
    }

  private:
    [[noreturn]] void refuse(const std::string& reason) const { throw ImagingError(path_, reason); }
    const DataSet& data() const { return reader_.GetFile().GetDataSet(); }

    void read_sizes() {
        rows_ = scan_->rows.value_or(0);
        columns_ = scan_->columns.value_or(0);
        bits_ = scan_->bits_allocated.value_or(0);
        const long frames = std::strtol(scan_->frames.c_str(), nullptr, 10);
        if (scan_->is_encapsulated)
            refuse(
                "is a segmentation with compressed pixels; save it uncompressed, or as .seg.nrrd from 3D "
                "Slicer");
        if (bits_ != 1 && bits_ != 8 && bits_ != 16)
            refuse(fmt::format("is a segmentation of {} bits (0028,0100); 1, 8 and 16 are read", bits_));
        if (rows_ < 2 || columns_ < 2 || frames < 1 || frames > 65536)
            refuse(fmt::format("is a segmentation of {} frames of {} x {} pixels", frames, columns_, rows_));
        frames_.resize(static_cast<std::size_t>(frames));
        const std::uint64_t pixels = std::uint64_t{frames_.size()} * pixels_of_frame();
        const std::uint64_t expected =
            bits_ == 1 ? (pixels + 7) / 8 : pixels * static_cast<std::uint64_t>(bits_ / 8);
        const gdcm::ByteValue* bytes = data().FindDataElement(Tag(0x7fe0, 0x0010))
                                           ? data().GetDataElement(Tag(0x7fe0, 0x0010)).GetByteValue()
                                           : nullptr;
        if (bytes == nullptr || bytes->GetLength() < expected)
            refuse(fmt::format("is cut off: {} of {} bytes of pixel data are there",
                               bytes == nullptr ? 0 : static_cast<std::uint64_t>(bytes->GetLength()),
                               expected));
        pixels_ = reinterpret_cast<const std::uint8_t*>(bytes->GetPointer());
        is_fractional_ = text_of(data(), Tag(0x0062, 0x0001)) == "FRACTIONAL";
        half_of_most_ = number_of(data(), Tag(0x0062, 0x000e), 255) / 2.0;
    }

    void read_frames() {
        const auto shared = sequence_of(data(), Tag(0x5200, 0x9229));
        const auto per_frame = sequence_of(data(), Tag(0x5200, 0x9230));
        if (!per_frame || per_frame->GetNumberOfItems() != frames_.size())
            refuse("is a segmentation that does not say where each frame lies (5200,9230)");
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            Places places{.in = {&per_frame->GetItem(i + 1).GetNestedDataSet()}};
            const auto segments = sequence_of(*places.in[0], Tag(0x0062, 0x000a));
            if (shared && shared->GetNumberOfItems() > 0)
                places.in.push_back(&shared->GetItem(1).GetNestedDataSet());
            const auto position = places.find<3>(Tag(0x0020, 0x9113), Tag(0x0020, 0x0032));
            const auto orientation = places.find<6>(Tag(0x0020, 0x9116), Tag(0x0020, 0x0037));
            const auto spacing = places.find<2>(Tag(0x0028, 0x9110), Tag(0x0028, 0x0030));
            if (!position || !orientation || !spacing)
                refuse(fmt::format("is a segmentation whose frame {} does not say how it lies in the patient",
                                   i + 1));
            frames_[i].position_mm = {(*position)[0], (*position)[1], (*position)[2]};
            along_row_ = {(*orientation)[0], (*orientation)[1], (*orientation)[2]};
            along_column_ = {(*orientation)[3], (*orientation)[4], (*orientation)[5]};
            pitch_mm_ = {(*spacing)[1], (*spacing)[0]};
            if (const auto gap = places.find<1>(Tag(0x0028, 0x9110), Tag(0x0018, 0x0088)))
                stated_gap_mm_ = std::abs((*gap)[0]);
            if (const auto thick = places.find<1>(Tag(0x0028, 0x9110), Tag(0x0018, 0x0050)))
                thickness_mm_ = std::abs((*thick)[0]);
            if (segments && segments->GetNumberOfItems() > 0)
                frames_[i].segment =
                    number_of(segments->GetItem(1).GetNestedDataSet(), Tag(0x0062, 0x000b), 0);
        }
    }

    /// The lattice of all frames; slices between them are empty.
    SourceImage placed_image() {
        const glm::dvec3 normal = glm::normalize(glm::cross(along_row_, along_column_));
        if (!std::isfinite(normal.x)) refuse("is a segmentation whose rows and columns have no directions");
        for (const SegmentFrame& frame : frames_)
            if (!is_plausible_position(frame.position_mm))
                refuse(implausible_position("the position of a frame"));
        std::map<long, std::size_t> heights;  // of distinct slices, in micrometres
        for (std::size_t i = 0; i < frames_.size(); ++i)
            heights.emplace(std::lround(1000.0 * glm::dot(frames_[i].position_mm, normal)), i);
        double gap_mm = 0.0;
        for (auto next = heights.begin(); next != heights.end(); ++next)
            if (next != heights.begin()) {
                const double step_mm = 1e-3 * static_cast<double>(next->first - std::prev(next)->first);
                if (gap_mm == 0.0 || step_mm < gap_mm) gap_mm = step_mm;
            }
        // Where few slices are there, what the file says is nearer the truth.
        if (stated_gap_mm_ > 0.0 && (gap_mm == 0.0 || stated_gap_mm_ < gap_mm)) gap_mm = stated_gap_mm_;
        if (gap_mm == 0.0) gap_mm = thickness_mm_;
        if (!is_plausible_spacing(gap_mm))
            refuse(implausible_spacing("Spacing Between Slices (0018,0088)", gap_mm));
        const double low_mm = 1e-3 * static_cast<double>(heights.begin()->first);
        const double high_mm = 1e-3 * static_cast<double>(heights.rbegin()->first);
        // A single slice of labels is a volume of one slice among empty ones.
        const int more = heights.size() == 1 ? 1 : 0;
        const double slices = std::round((high_mm - low_mm) / gap_mm) + 1 + more;
        if (slices > static_cast<double>(most_voxels_of_an_axis))
            refuse("is a segmentation of more than 65535 slices");
        SourceImage image{.size_voxels = {columns_, rows_, static_cast<int>(slices)},
                          .spacing_mm = {pitch_mm_.x, pitch_mm_.y, gap_mm},
                          .origin_mm = frames_[heights.begin()->second].position_mm};
        image.direction = glm::dmat3(glm::normalize(along_row_), glm::normalize(along_column_), normal);
        settle_geometry(image, path_);
        if (voxel_count(image) > most_segmentation_voxels)
            refuse("has more than 2^31 labels; crop it in 3D Slicer");
        for (const SegmentFrame& frame : frames_) {
            const double slice = (glm::dot(frame.position_mm, normal) - low_mm) / gap_mm;
            if (std::abs(slice - std::round(slice)) > std::max(slice_tolerance, 1e-3 / gap_mm))
                refuse("is a segmentation whose frames lie at no common spacing");
            slice_of_frame_.push_back(static_cast<std::size_t>(std::lround(slice)));
        }
        return image;
    }

    std::uint16_t pixel(std::size_t frame, std::size_t i) const {
        const std::size_t at = frame * pixels_of_frame() + i;
        if (bits_ == 1) return (pixels_[at / 8] >> (at % 8)) & 1U;
        const std::uint16_t value =
            bits_ == 8 ? pixels_[at]
                       : static_cast<std::uint16_t>(pixels_[2 * at] | pixels_[2 * at + 1] << 8U);
        if (frames_[frame].segment == 0) return value;
        return is_fractional_ ? value >= half_of_most_ : value != 0;
    }

    /// Each segment in the first layer where nothing else is.
    std::vector<Layer> filled(const SourceImage& image) {
        std::vector<Layer> layers;
        std::map<int, std::vector<std::size_t>> frames_of_segment;
        for (std::size_t i = 0; i < frames_.size(); ++i) frames_of_segment[frames_[i].segment].push_back(i);
        for (const auto& [segment, frames] : frames_of_segment) {
            std::size_t layer = 0;
            while (layer < layers.size() && overlaps(layers[layer], frames)) ++layer;
            if (layer == layers.size()) {
                if (layers.size() == most_layers_of_segments ||
                    (layer + 1) * voxel_count(image) > most_segmentation_voxels)
                    refuse("has segments that overlap in too many layers");
                layers.emplace_back(voxel_count(image));
            }
            layer_of_segment_[segment] = layer;
            for (const std::size_t frame : frames)
                for (std::size_t i = 0; i < pixels_of_frame(); ++i)
                    if (const std::uint16_t value = pixel(frame, i); value != 0)
                        layers[layer][slice_of_frame_[frame] * pixels_of_frame() + i] =
                            segment == 0 ? value : static_cast<std::uint16_t>(segment);
        }
        return layers;
    }
    bool overlaps(const Layer& layer, const std::vector<std::size_t>& frames) const {
        for (const std::size_t frame : frames)
            for (std::size_t i = 0; i < pixels_of_frame(); ++i)
                if (layer[slice_of_frame_[frame] * pixels_of_frame() + i] != 0 && pixel(frame, i) != 0)
                    return true;
        return false;
    }

    void name_segments(OpenedImage& opened) const {
        const auto segments = sequence_of(data(), Tag(0x0062, 0x0002));
        int named = 0;
        for (std::size_t i = 1; segments && i <= segments->GetNumberOfItems(); ++i) {
            const DataSet& segment = segments->GetItem(i).GetNestedDataSet();
            const int number = number_of(segment, Tag(0x0062, 0x0004), 0);
            if (number == 0) continue;
            std::string name = text_of(segment, Tag(0x0062, 0x0005));
            if (name.empty()) name = std::to_string(number);
            const auto layer =
                layer_of_segment_.contains(0) ? layer_of_segment_.find(0) : layer_of_segment_.find(number);
            const std::string key = fmt::format("Segment{}_", named++);
            opened.key_values[key + "Name"] = name;
            opened.key_values[key + "LabelValue"] = std::to_string(number);
            opened.key_values[key + "Layer"] =
                std::to_string(layer == layer_of_segment_.end() ? 0 : layer->second);
        }
    }

    std::size_t pixels_of_frame() const {
        return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_);
    }

    std::filesystem::path path_;
    std::optional<DicomScan> scan_;
    gdcm::Reader reader_;
    int rows_ = 0;
    int columns_ = 0;
    int bits_ = 0;
    bool is_fractional_ = false;
    double half_of_most_ = 0.0;
    const std::uint8_t* pixels_ = nullptr;
    glm::dvec3 along_row_{0.0};
    glm::dvec3 along_column_{0.0};
    glm::dvec2 pitch_mm_{0.0};
    double stated_gap_mm_ = 0.0;
    double thickness_mm_ = 0.0;
    std::vector<SegmentFrame> frames_;
    std::vector<std::size_t> slice_of_frame_;
    std::map<int, std::size_t> layer_of_segment_;
};

}  // namespace

bool is_dicom_segmentation(const std::filesystem::path& path) {
    const InputFile file(path);
    if (!may_be_dicom(file.first_bytes(dicom_mark_bytes)) || file.size() > most_segmentation_bytes)
        return false;
    try {
        const std::optional<DicomScan> scan = scan_dicom(file.first_bytes(file.size()), file.size());
        return scan && (scan->sop_class == "1.2.840.10008.5.1.4.1.1.66.4" ||
                        scan->sop_class == "1.2.840.10008.5.1.4.1.1.66.7");
    } catch (const std::invalid_argument&) {
        return false;
    }
}

OpenedImage open_dicom_segmentation(const std::filesystem::path& path) {
    return SegmentationSource(path).open();
}

}  // namespace osteomill
