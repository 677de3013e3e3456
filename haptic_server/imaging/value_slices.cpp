#include "haptic_server/imaging/value_slices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <vector>

namespace osteomill {

namespace {

/// Turns bytes into values as they come; a voxel may lie across two pieces.
template <typename Voxel>
class Converter {
  public:
    Converter(const VoxelLayout& layout, const glm::ivec3& size_voxels, const TakeSlice& take,
              const ReportProgress& report)
        : swapped_(layout.big_endian != (std::endian::native == std::endian::big)),
          slices_(size_voxels.z),
          take_(take),
          report_(report),
          slice_(static_cast<std::size_t>(size_voxels.x) * static_cast<std::size_t>(size_voxels.y)) {}

    void take(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) {
            raw_[filled_++] = byte;
            if (filled_ == sizeof(Voxel)) take_voxel();
        }
    }

  private:
    void take_voxel() {
        filled_ = 0;
        if (k_ == slices_) return;
        std::array<std::uint8_t, sizeof(Voxel)> ordered = raw_;
        if (swapped_) std::reverse(ordered.begin(), ordered.end());
        Voxel voxel{};
        std::memcpy(&voxel, ordered.data(), sizeof voxel);
        slice_[values_++] = static_cast<float>(voxel);
        if (values_ < slice_.size()) return;
        values_ = 0;
        take_(k_++, slice_);
        report_(static_cast<double>(k_) / slices_);
    }

    bool swapped_;
    int slices_;
    const TakeSlice& take_;
    const ReportProgress& report_;
    std::vector<float> slice_;
    std::size_t values_ = 0;
    int k_ = 0;
    std::array<std::uint8_t, sizeof(Voxel)> raw_{};
    std::size_t filled_ = 0;
};

template <typename Voxel>
void read_slices_of(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                    const TakeSlice& take, const ReportProgress& report) {
    Converter<Voxel> converter(layout, size_voxels, take, report);
    std::uint64_t to_skip = layout.skipped_bytes;
    read_voxel_data(data, [&](std::span<const std::uint8_t> bytes) {
        const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(to_skip, bytes.size()));
        to_skip -= skipped;
        converter.take(bytes.subspan(skipped));
    });
}

}  // namespace

void read_value_slices(const VoxelData& data, const VoxelLayout& layout, const glm::ivec3& size_voxels,
                       const TakeSlice& take, const ReportProgress& report) {
    switch (layout.element) {
        case MetaElement::int8:
            return read_slices_of<std::int8_t>(data, layout, size_voxels, take, report);
        case MetaElement::uint8:
            return read_slices_of<std::uint8_t>(data, layout, size_voxels, take, report);
        case MetaElement::int16:
            return read_slices_of<std::int16_t>(data, layout, size_voxels, take, report);
        case MetaElement::uint16:
            return read_slices_of<std::uint16_t>(data, layout, size_voxels, take, report);
        case MetaElement::int32:
            return read_slices_of<std::int32_t>(data, layout, size_voxels, take, report);
        case MetaElement::uint32:
            return read_slices_of<std::uint32_t>(data, layout, size_voxels, take, report);
        case MetaElement::float32:
            return read_slices_of<float>(data, layout, size_voxels, take, report);
        case MetaElement::float64:
            return read_slices_of<double>(data, layout, size_voxels, take, report);
    }
}

}  // namespace osteomill
