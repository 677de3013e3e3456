#include "imaging/dicom/dicom_segmentation.h"

#include <fmt/format.h>
#include <gdcmReader.h>
#include <iconv.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>

#include "common/files/input_file.h"
#include "imaging/dicom/data_set.h"
#include "imaging/dicom/dicom_frames.h"
#include "imaging/dicom/dicom_header.h"
#include "imaging/dicom/dicom_pixels.h"
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

/// One layer of labels, x fastest; a segment of frames that overlap others lies in another.
using Layer = std::vector<std::uint16_t>;

/// Converts a text of a file whose Specific Character Set (0008,0005) is `set`; returns it unchanged for a
/// set that is not in the table.
std::string in_utf8(const std::string& text, const std::string& set) {
    static const std::map<std::string, const char*> known{
        {"ISO_IR 100", "ISO-8859-1"}, {"ISO_IR 101", "ISO-8859-2"}, {"ISO_IR 109", "ISO-8859-3"},
        {"ISO_IR 110", "ISO-8859-4"}, {"ISO_IR 144", "ISO-8859-5"}, {"ISO_IR 127", "ISO-8859-6"},
        {"ISO_IR 126", "ISO-8859-7"}, {"ISO_IR 138", "ISO-8859-8"}, {"ISO_IR 148", "ISO-8859-9"},
        {"ISO_IR 166", "TIS-620"},    {"ISO_IR 13", "SHIFT_JIS"},   {"GB18030", "GB18030"}};
    const auto from = known.find(set);
    if (from == known.end()) return text;
    const iconv_t converter = ::iconv_open("UTF-8", from->second);
    if (converter == reinterpret_cast<iconv_t>(-1)) return text;
    std::string in = text, out(4 * text.size(), '\0');
    char* read = in.data();
    char* written = out.data();
    std::size_t left = in.size(), room = out.size();
    const bool is_whole = ::iconv(converter, &read, &left, &written, &room) != static_cast<std::size_t>(-1);
    ::iconv_close(converter);
    return is_whole ? out.substr(0, out.size() - room) : text;
}

/// The segments' frames, and their contents.
class SegmentationSource {
  public:
    explicit SegmentationSource(const std::filesystem::path& path) : path_(path) {
        if (InputFile(path).size() > most_segmentation_bytes)
            throw ImagingError(path, "is a segmentation of more than 1 GiB");
        std::optional<DicomHeader> header = read_dicom_header(path);
        reader_.SetFileName(path.c_str());
        if (!header || !quietly([&] { return reader_.Read(); }))
            throw ImagingError(path, "is DICOM but cannot be parsed: cut off or damaged");
        header_ = std::move(*header);
        find_pixels();
        find_segments();
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

    void find_pixels() {
        const int bits = header_.scan.bits_allocated.value_or(0);
        if (bits != 1 && bits != 8 && bits != 16)
            refuse(fmt::format("is a segmentation of {} bits (0028,0100); 1, 8 and 16 are read", bits));
        if (header_.rows < 2 || header_.columns < 2)
            refuse(fmt::format("is a segmentation of {} x {} pixels", header_.columns, header_.rows));
        is_fractional_ = text_of(data(), Tag(0x0062, 0x0001)) == "FRACTIONAL";
        half_of_most_ = static_cast<float>(number_of(data(), Tag(0x0062, 0x000e)).value_or(255)) / 2.0F;
        if (bits != 1) {
            try {
                require_sound_pixels(header_.scan);
            } catch (const std::invalid_argument& error) {
                refuse(error.what());
            }
            wider_.emplace(DicomFile{path_, header_});
            return;
        }
        if (header_.scan.is_encapsulated)
            refuse(
                "is a segmentation with compressed pixels of one bit; save it uncompressed, or as .seg.nrrd "
                "from "
                "3D Slicer");
        const std::uint64_t expected = (std::uint64_t{header_.frames.size()} * pixels_of_frame() + 7) / 8;
        const gdcm::ByteValue* bytes = data().FindDataElement(Tag(0x7fe0, 0x0010))
                                           ? data().GetDataElement(Tag(0x7fe0, 0x0010)).GetByteValue()
                                           : nullptr;
        const std::uint64_t there = bytes == nullptr ? 0 : static_cast<std::uint64_t>(bytes->GetLength());
        if (there < expected)
            refuse(fmt::format("is cut off: {} of {} bytes of pixel data are there", there, expected));
        bits_ = reinterpret_cast<const std::uint8_t*>(bytes->GetPointer());
        // Some writers begin each frame with a byte of its own, where frames follow one another by the bit.
        const std::uint64_t padded = std::uint64_t{header_.frames.size()} * ((pixels_of_frame() + 7) / 8);
        const bool is_padded =
            there > expected + expected % 2 && (there == padded || there == padded + padded % 2);
        bits_of_frame_ = is_padded ? (pixels_of_frame() + 7) / 8 * 8 : pixels_of_frame();
    }

    void find_segments() {
        const FrameGroups groups(data());
        if (groups.count() != header_.frames.size())
            refuse("is a segmentation that does not say where each frame lies (5200,9230)");
        if (!header_.fault.empty()) refuse(header_.fault);
        for (const auto& [number, name] : described_segments())
            if (!numbers_.insert(number).second)
                refuse(fmt::format("has two segments of the number {} (0062,0004)", number));
        const bool is_of_numbers =
            is_label_map(header_.scan) || text_of(data(), Tag(0x0062, 0x0001)) == "LABELMAP";
        for (std::size_t i = 0; i < groups.count(); ++i)
            segment_of_frame_.push_back(is_of_numbers ? 0 : segment_in(groups.of(i), i + 1));
    }
    /// Numbers and names.
    std::vector<std::pair<int, std::string>> described_segments() const {
        std::vector<std::pair<int, std::string>> described;
        const auto segments = sequence_of(data(), Tag(0x0062, 0x0002));
        for (std::size_t i = 1; segments && i <= segments->GetNumberOfItems(); ++i) {
            const DataSet& segment = segments->GetItem(i).GetNestedDataSet();
            const int number = number_of(segment, Tag(0x0062, 0x0004)).value_or(0);
            if (number == 0) continue;
            const std::string name = text_of(segment, Tag(0x0062, 0x0005));
            described.emplace_back(number, name.empty()
                                               ? std::to_string(number)
                                               : in_utf8(name, text_of(data(), Tag(0x0008, 0x0005))));
        }
        return described;
    }
    /// The segment of a frame, which the frame states itself or the shared groups state for all; a file of a
    /// single segment need not state it.
    int segment_in(const Places& places, std::size_t frame) const {
        for (const DataSet* place : places.in) {
            const auto named = sequence_of(*place, Tag(0x0062, 0x000a));
            if (!named || named->GetNumberOfItems() == 0) continue;
            const int number =
                number_of(named->GetItem(1).GetNestedDataSet(), Tag(0x0062, 0x000b)).value_or(0);
            if (!numbers_.empty() && !numbers_.contains(number))
                refuse(fmt::format("its frame {} is of segment {} (0062,000b), which it does not describe",
                                   frame, number));
            return number;
        }
        if (numbers_.size() != 1)
            refuse(fmt::format("its frame {} does not say of which segment it is (0062,000a)", frame));
        return *numbers_.begin();
    }

    /// The lattice of all frames; slices between them are empty.
    SourceImage placed_image() {
        std::vector<SlicePlacement> frames;
        for (std::size_t i = 0; i < header_.frames.size(); ++i) {
            frames.push_back(*header_.frames[i]);
            frames.back().name = fmt::format("frame {}", i + 1);
        }
        SliceLattice lattice;
        try {
            lattice = lattice_of(frames, {header_.slice_gap_mm, header_.slice_thickness_mm});
        } catch (const std::invalid_argument& error) {
            refuse(error.what());
        }
        SourceImage image{.size_voxels = {header_.columns, header_.rows, static_cast<int>(lattice.slices)},
                          .spacing_mm = lattice.spacing_mm,
                          .origin_mm = lattice.origin_mm};
        image.direction = lattice.direction;
        if (!lattice.note.empty()) image.notes.push_back(path_.string() + ": " + lattice.note);
        settle_geometry(image, path_);
        if (voxel_count(image) > most_segmentation_voxels)
            refuse("has more than 2^31 labels; crop it in 3D Slicer");
        slice_of_frame_ = std::move(lattice.slice_of);
        return image;
    }

    /// The labels of a frame's pixels, one behind the other; 0 outside its segment.
    Layer labels_of(std::size_t frame) {
        const int segment = segment_of_frame_[frame];
        const auto label = static_cast<std::uint16_t>(std::max(segment, 1));
        Layer labels(pixels_of_frame());
        if (bits_ != nullptr) {
            for (std::size_t i = 0, at = frame * bits_of_frame_; i < labels.size(); ++i, ++at)
                labels[i] = (bits_[at / 8] >> (at % 8) & 1U) != 0 ? label : std::uint16_t{0};
            return labels;
        }
        std::ranges::transform(wider_->frame(static_cast<unsigned>(frame)), labels.begin(), [&](float value) {
            if (!(value > 0.0F)) return std::uint16_t{0};  // or not a number: padding
            if (segment == 0) return static_cast<std::uint16_t>(std::min(value, 65535.0F));
            return is_fractional_ && value < half_of_most_ ? std::uint16_t{0} : label;
        });
        return labels;
    }

    /// Each segment in the first layer where nothing else is.
    std::vector<Layer> filled(const SourceImage& image) {
        std::vector<Layer> layers;
        std::map<int, std::vector<std::size_t>> frames_of_segment;
        for (std::size_t i = 0; i < segment_of_frame_.size(); ++i)
            frames_of_segment[segment_of_frame_[i]].push_back(i);
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
            for (const std::size_t frame : frames) {
                const auto slice = slice_in(layers[layer], frame);
                std::ranges::transform(
                    labels_of(frame), slice, slice.begin(),
                    [](std::uint16_t label, std::uint16_t before) { return label != 0 ? label : before; });
            }
        }
        return layers;
    }
    std::span<std::uint16_t> slice_in(Layer& layer, std::size_t frame) const {
        return std::span(layer).subspan(slice_of_frame_[frame] * pixels_of_frame(), pixels_of_frame());
    }
    bool overlaps(Layer& layer, const std::vector<std::size_t>& frames) {
        return std::ranges::any_of(frames, [&](std::size_t frame) {
            const Layer labels = labels_of(frame);
            const auto slice = slice_in(layer, frame);
            for (std::size_t i = 0; i < labels.size(); ++i)
                if (labels[i] != 0 && slice[i] != 0) return true;
            return false;
        });
    }

    void name_segments(OpenedImage& opened) const {
        int named = 0;
        for (const auto& [number, name] : described_segments()) {
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
        return static_cast<std::size_t>(header_.rows) * static_cast<std::size_t>(header_.columns);
    }

    std::filesystem::path path_;
    DicomHeader header_;
    gdcm::Reader reader_;
    const std::uint8_t* bits_ = nullptr;  // all frames' pixels, if a pixel is one bit
    std::size_t bits_of_frame_ = 0;
    std::optional<DicomFrames> wider_{};  // if a pixel is more
    bool is_fractional_ = false;
    float half_of_most_ = 0.0F;
    std::set<int> numbers_;              // the segments that are described
    std::vector<int> segment_of_frame_;  // 0 for a label map, whose pixels are segments
    std::vector<std::size_t> slice_of_frame_;
    std::map<int, std::size_t> layer_of_segment_;
};

}  // namespace

bool is_dicom_segmentation(const std::filesystem::path& path) {
    try {
        const std::optional<DicomHeader> header = read_dicom_header(path);
        return header && is_segmentation(header->scan);
    } catch (const std::runtime_error&) {
        return false;
    }
}

OpenedImage open_dicom_segmentation(const std::filesystem::path& path) {
    return SegmentationSource(path).open();
}

}  // namespace osteomill
