#include "imaging/formats/value_slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/imaging_error.h"

namespace osteomill {

namespace {

/// Fills slices and hands them on; data after the last one are skipped.
class SliceFiller {
  public:
    SliceFiller(const VoxelLayout& layout, const glm::ivec3& size_voxels, const TakeSlice& take,
                const ReportProgress& report)
        : slope_(layout.slope),
          intercept_(layout.intercept),
          slices_(size_voxels.z),
          take_(take),
          report_(report),
          slice_(static_cast<std::size_t>(size_voxels.x) * static_cast<std::size_t>(size_voxels.y)) {}

    template <typename Voxel>
    void add(Voxel voxel) {
        if (is_full()) return;
        slice_[values_++] = static_cast<float>(slope_ * static_cast<double>(voxel) + intercept_);
        if (values_ < slice_.size()) return;
        values_ = 0;
        take_(k_++, slice_);
        report_(static_cast<double>(k_) / slices_);
    }
    bool is_full() const { return k_ == slices_; }

  private:
    double slope_;
    double intercept_;
    int slices_;
    const TakeSlice& take_;
    const ReportProgress& report_;
    std::vector<float> slice_;
    std::size_t values_ = 0;
    int k_ = 0;
};

/// Turns bytes into values as they come; a voxel may lie across two pieces.
template <typename Voxel>
class BinaryConverter {
  public:
    BinaryConverter(bool big_endian, SliceFiller& slices)
        : swapped_(big_endian != (std::endian::native == std::endian::big)), slices_(slices) {}

    void take(std::span<const std::byte> bytes) {
        while (filled_ > 0 && !bytes.empty()) {
            broken_[filled_++] = bytes.front();
            bytes = bytes.subspan(1);
            if (filled_ < sizeof(Voxel)) continue;
            add(broken_.data());
            filled_ = 0;
        }
        for (; bytes.size() >= sizeof(Voxel); bytes = bytes.subspan(sizeof(Voxel))) add(bytes.data());
        for (const std::byte byte : bytes) broken_[filled_++] = byte;
    }

  private:
    void add(const std::byte* bytes) {
        std::array<std::byte, sizeof(Voxel)> ordered;
        std::copy_n(bytes, sizeof(Voxel), ordered.begin());
        if (swapped_) std::reverse(ordered.begin(), ordered.end());
        Voxel voxel{};
        std::memcpy(&voxel, ordered.data(), sizeof voxel);
        slices_.add(voxel);
    }

    bool swapped_;
    SliceFiller& slices_;
    std::array<std::byte, sizeof(Voxel)> broken_{};
    std::size_t filled_ = 0;
};

/// Numbers in decimal, with blanks or commas between.
class TextConverter {
  public:
    TextConverter(const std::filesystem::path& path, SliceFiller& slices) : path_(path), slices_(slices) {}

    void take(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) {
            const auto letter = static_cast<char>(byte);
            if (letter == ',' || letter == ' ' || (letter >= '\t' && letter <= '\r')) {
                end_word();
            } else if (!slices_.is_full()) {
                word_ += letter;
                if (word_.size() > longest_word) refuse();
            }
        }
    }

  private:
    static constexpr std::size_t longest_word = 64;

    void end_word() {
        if (word_.empty()) return;
        const std::string_view digits = std::string_view(word_).substr(word_.front() == '+' ? 1 : 0);
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc() || end != digits.data() + digits.size()) refuse();
        slices_.add(value);
        word_.clear();
    }
    [[noreturn]] void refuse() const {
        throw ImagingError(path_, fmt::format("its voxels are damaged: '{}' is no number", word_));
    }

    const std::filesystem::path& path_;
    SliceFiller& slices_;
    std::string word_;
};

template <typename Voxel>
void read_binary(const VoxelData& data, const VoxelLayout& layout, SliceFiller& slices) {
    BinaryConverter<Voxel> converter(layout.big_endian, slices);
    read_voxel_data(data, [&](std::span<const std::byte> bytes) { converter.take(bytes); });
}

void read_text(const VoxelData& data, SliceFiller& slices) {
    TextConverter converter(data.parts.front().file, slices);
    read_voxel_data(data, [&](std::span<const std::byte> bytes) { converter.take(bytes); });
    if (!slices.is_full())
        throw ImagingError(data.parts.front().file, "is cut off: it holds fewer numbers than voxels");
}

}  // namespace

void read_value_slices(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                       const TakeSlice& take, const ReportProgress& report) {
    SliceFiller slices(layout, size_voxels, take, report);
    if (data.encoding == Encoding::text) return read_text(data, slices);
    // By VoxelType.
    constexpr std::array readers{read_binary<std::int8_t>,  read_binary<std::uint8_t>,
                                 read_binary<std::int16_t>, read_binary<std::uint16_t>,
                                 read_binary<std::int32_t>, read_binary<std::uint32_t>,
                                 read_binary<std::int64_t>, read_binary<std::uint64_t>,
                                 read_binary<float>,        read_binary<double>};
    readers[static_cast<std::size_t>(layout.type)](data, layout, slices);
}

}  // namespace osteomill
