#include "haptic_server/imaging/refine.h"

#include <itkBSplineInterpolateImageFunction.h>
#include <itkExtractImageFilter.h>
#include <itkIdentityTransform.h>
#include <itkMinimumMaximumImageCalculator.h>
#include <itkRecursiveGaussianImageFilter.h>
#include <itkResampleImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

namespace osteomill {

namespace {

constexpr double air_hu = -1000.0;
constexpr double coarsening_that_needs_smoothing = 1.5;
/// Voxels of the scan around a region that its spline needs.
constexpr long spline_margin = 6;

ScanImage::PointType point(const glm::dvec3& p) {
    const std::array<double, 3> values{p.x, p.y, p.z};
    return ScanImage::PointType(values.data());
}

/// The part of the scan that a grid needs, with a margin for the spline.
ScanImage::Pointer cropped(const ScanImage& scan, const Grid& grid) {
    const auto whole = scan.GetLargestPossibleRegion();
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    low.fill(1e300);
    high.fill(-1e300);
    const glm::dvec3 first = grid.origin_mm;
    const glm::dvec3 last = centre_of_voxel_mm(grid, grid.size_voxels - 1);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 p((corner & 1) ? last.x : first.x, (corner & 2) ? last.y : first.y,
                           (corner & 4) ? last.z : first.z);
        const auto index = scan.TransformPhysicalPointToContinuousIndex<double>(point(p));
        for (unsigned axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], index[axis]);
            high[axis] = std::max(high[axis], index[axis]);
        }
    }
    ScanImage::RegionType wanted;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const long begin = static_cast<long>(std::floor(low[axis])) - spline_margin;
        const long end = static_cast<long>(std::ceil(high[axis])) + spline_margin + 1;
        wanted.SetIndex(axis, begin);
        wanted.SetSize(axis, static_cast<itk::SizeValueType>(end - begin));
    }
    wanted.Crop(whole);
    const auto extract = itk::ExtractImageFilter<ScanImage, ScanImage>::New();
    extract->SetInput(&scan);
    extract->SetExtractionRegion(wanted);
    extract->SetDirectionCollapseToIdentity();
    extract->Update();
    return extract->GetOutput();
}

ScanImage::Pointer smoothed_for(ScanImage::Pointer scan, double spacing_mm) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        if (spacing_mm <= coarsening_that_needs_smoothing * scan->GetSpacing()[axis]) continue;
        if (scan->GetLargestPossibleRegion().GetSize()[axis] < 4)
            continue;  // too thin for the recursive filter
        const auto filter = itk::RecursiveGaussianImageFilter<ScanImage, ScanImage>::New();
        filter->SetInput(scan);
        filter->SetDirection(axis);
        filter->SetSigma(0.5 * spacing_mm);
        filter->Update();
        scan = filter->GetOutput();
    }
    return scan;
}

}  // namespace

Region extent_of(const ScanImage& scan) {
    const auto whole = scan.GetLargestPossibleRegion();
    Region extent{glm::dvec3(1e300), glm::dvec3(-1e300)};
    for (int corner = 0; corner < 8; ++corner) {
        ScanImage::IndexType index = whole.GetIndex();
        for (unsigned axis = 0; axis < 3; ++axis)
            if (corner >> axis & 1) index[axis] += static_cast<long>(whole.GetSize()[axis]) - 1;
        ScanImage::PointType p;
        scan.TransformIndexToPhysicalPoint(index, p);
        extent.low_mm = glm::min(extent.low_mm, glm::dvec3(p[0], p[1], p[2]));
        extent.high_mm = glm::max(extent.high_mm, glm::dvec3(p[0], p[1], p[2]));
    }
    return extent;
}

std::optional<Region> intersection(const Region& a, const Region& b) {
    const Region shared{glm::max(a.low_mm, b.low_mm), glm::min(a.high_mm, b.high_mm)};
    for (int axis = 0; axis < 3; ++axis)
        if (!(shared.low_mm[axis] < shared.high_mm[axis])) return std::nullopt;
    return shared;
}

Grid grid_of(const Region& region, double spacing_mm) {
    // A last voxel that misses the region's edge by rounding alone still counts.
    const glm::dvec3 cells = glm::floor((region.high_mm - region.low_mm) / spacing_mm + 1e-6);
    return {.size_voxels = glm::ivec3(glm::min(cells, glm::dvec3(1e9))) + 1,
            .spacing_mm = spacing_mm,
            .origin_mm = region.low_mm};
}

double refine_memory_bytes(const ScanImage& scan, const Region& region, double spacing_mm) {
    const glm::dvec3 cells = (region.high_mm - region.low_mm) / spacing_mm + 1.0;
    double scan_share = static_cast<double>(scan.GetLargestPossibleRegion().GetNumberOfPixels());
    const Region extent = extent_of(scan);
    for (int axis = 0; axis < 3; ++axis)
        scan_share *= std::min(1.0, (region.high_mm[axis] - region.low_mm[axis] + 1.0) /
                                        std::max(1e-6, extent.high_mm[axis] - extent.low_mm[axis]));
    // The volume in 16 bits, its deflated copy on the way to the file, one slab in floats, the part of the
    // scan as floats and as spline coefficients in doubles.
    return cells.x * cells.y * (cells.z * 4.0 + 16.0 * 4.0) + scan_share * 16.0;
}

HuVolume refine(const ScanImage& scan, const Grid& grid, const Progress& progress) {
    require_valid(grid);
    const ScanImage::Pointer part = smoothed_for(cropped(scan, grid), grid.spacing_mm);
    const auto range = itk::MinimumMaximumImageCalculator<ScanImage>::New();
    range->SetImage(part);
    range->Compute();
    const auto lowest = static_cast<double>(range->GetMinimum());
    const auto highest = static_cast<double>(range->GetMaximum());

    const auto spline = itk::BSplineInterpolateImageFunction<ScanImage, double, double>::New();
    spline->SetSplineOrder(3);
    const auto resample = itk::ResampleImageFilter<ScanImage, ScanImage>::New();
    resample->SetInput(part);
    resample->SetInterpolator(spline);
    resample->SetTransform(itk::IdentityTransform<double, 3>::New());
    resample->SetDefaultPixelValue(static_cast<float>(air_hu));
    const std::array<double, 3> spacing{grid.spacing_mm, grid.spacing_mm, grid.spacing_mm};
    resample->SetOutputSpacing(spacing.data());

    HuVolume volume{.grid = grid, .hu = {}, .tissue = {}};
    const glm::ivec3 size = grid.size_voxels;
    volume.hu.reserve(static_cast<std::size_t>(size.x) * size.y * size.z);
    constexpr int slab = 16;
    for (int z = 0; z < size.z; z += slab) {
        const int slices = std::min(slab, size.z - z);
        resample->SetOutputOrigin(point(centre_of_voxel_mm(grid, {0, 0, z})));
        ScanImage::SizeType slab_size;
        slab_size[0] = static_cast<itk::SizeValueType>(size.x);
        slab_size[1] = static_cast<itk::SizeValueType>(size.y);
        slab_size[2] = static_cast<itk::SizeValueType>(slices);
        resample->SetSize(slab_size);
        resample->UpdateLargestPossibleRegion();
        const float* values = resample->GetOutput()->GetBufferPointer();
        const std::size_t count = slab_size[0] * slab_size[1] * slab_size[2];
        for (std::size_t i = 0; i < count; ++i) {
            const double hu = values[i] == static_cast<float>(air_hu)
                                  ? air_hu
                                  : std::clamp(static_cast<double>(values[i]), lowest, highest);
            volume.hu.push_back(static_cast<std::int16_t>(std::lround(std::clamp(hu, -32768.0, 32767.0))));
        }
        progress(static_cast<double>(z + slices) / size.z);
    }
    return volume;
}

void clear_far_from_bone(HuVolume& volume, double threshold_hu) {
    const glm::ivec3 size = volume.grid.size_voxels;
    constexpr int reach = 2;
    const auto voxels = static_cast<std::size_t>(size.x) * size.y * size.z;
    std::vector<std::uint8_t> near(voxels);
    for (std::size_t i = 0; i < voxels; ++i) near[i] = volume.hu[i] >= threshold_hu;
    // A box grows axis by axis.
    const std::array<std::size_t, 3> stride{1, static_cast<std::size_t>(size.x),
                                            static_cast<std::size_t>(size.x) * size.y};
    std::vector<std::uint8_t> line;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const std::size_t length = static_cast<std::size_t>(size[axis]);
        line.resize(length);
        for (std::size_t start = 0; start < voxels; ++start) {
            if (start / stride[a] % length != 0) continue;
            for (std::size_t i = 0; i < length; ++i) line[i] = near[start + i * stride[a]];
            for (std::size_t i = 0; i < length; ++i) {
                if (line[i] == 0) continue;
                const std::size_t first = i < reach ? 0 : i - reach;
                const std::size_t last = std::min(length - 1, i + reach);
                for (std::size_t j = first; j <= last; ++j) near[start + j * stride[a]] = 1;
            }
        }
    }
    for (std::size_t i = 0; i < voxels; ++i)
        if (near[i] == 0) volume.hu[i] = static_cast<std::int16_t>(air_hu);
}

}  // namespace osteomill
