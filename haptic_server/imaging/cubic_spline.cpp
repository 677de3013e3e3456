#include "haptic_server/imaging/cubic_spline.h"

#include <itkBSplineDecompositionImageFilter.h>
#include <itkDiscreteGaussianImageFilter.h>

#include <algorithm>
#include <cmath>

namespace osteomill {

namespace {

using FloatImage = itk::Image<float, 3>;

constexpr double fwhm_per_sigma = 2.3548200450309493;
/// A result coarser by less than this is not worth smoothing.
constexpr double coarser_tolerance = 1.01;

FloatImage::Pointer borrowed(SourceImage& image) {
    const auto borrowed = FloatImage::New();
    FloatImage::SizeType size;
    for (unsigned axis = 0; axis < 3; ++axis)
        size[axis] = static_cast<itk::SizeValueType>(image.size_voxels[static_cast<int>(axis)]);
    borrowed->SetRegions(size);
    const auto container = FloatImage::PixelContainer::New();
    container->SetImportPointer(image.values.data(), image.values.size(), false);
    borrowed->SetPixelContainer(container);
    return borrowed;
}

template <typename Filter>
void run_in_place(Filter& filter, SourceImage& image) {
    filter.SetInput(borrowed(image));
    filter.Update();
    std::copy_n(filter.GetOutput()->GetBufferPointer(), image.values.size(), image.values.begin());
}

int mirrored(int index, int size) {
    if (size == 1) return 0;
    const int period = 2 * (size - 1);
    const int within = ((index % period) + period) % period;
    return std::min(within, period - within);
}

}  // namespace

SplineTaps spline_taps(double at, int size) {
    const double below = std::floor(at);
    const double t = at - below;
    const double u = 1.0 - t;
    const std::array<double, 4> weight{u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
                                       (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0};
    SplineTaps taps;
    for (int i = 0; i < 4; ++i) {
        const auto tap = static_cast<std::size_t>(i);
        taps.index[tap] = mirrored(static_cast<int>(below) - 1 + i, size);
        taps.weight[tap] = static_cast<float>(weight[tap]);
    }
    return taps;
}

void values_to_coefficients(SourceImage& image) {
    const auto filter = itk::BSplineDecompositionImageFilter<FloatImage, FloatImage>::New();
    filter->SetSplineOrder(3);
    run_in_place(*filter, image);
}

void smooth_for_spacing(SourceImage& image, double spacing_mm) {
    FloatImage::SpacingType variance;
    variance.Fill(0.0);
    bool any = false;
    double widest = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double ratio = spacing_mm / image.spacing_mm[axis];
        if (ratio < coarser_tolerance) continue;
        any = true;
        const double sigma_voxels = std::sqrt(ratio * ratio - 1.0) / fwhm_per_sigma;
        variance[static_cast<unsigned>(axis)] = sigma_voxels * sigma_voxels;
        widest = std::max(widest, sigma_voxels);
    }
    if (!any) return;
    using Gaussian = itk::DiscreteGaussianImageFilter<FloatImage, FloatImage>;
    const auto filter = Gaussian::New();
    filter->SetUseImageSpacingOff();
    Gaussian::ArrayType variances;
    for (unsigned axis = 0; axis < 3; ++axis) variances[axis] = variance[axis];
    filter->SetVariance(variances);
    filter->SetMaximumError(0.01);
    filter->SetMaximumKernelWidth(static_cast<unsigned>(std::ceil(8.0 * widest)) + 3);
    run_in_place(*filter, image);
}

}  // namespace osteomill
