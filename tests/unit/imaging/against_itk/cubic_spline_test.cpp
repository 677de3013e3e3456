#include "imaging/resampling/cubic_spline.h"

#include <gtest/gtest.h>
#include <itkBSplineDecompositionImageFilter.h>
#include <itkDiscreteGaussianImageFilter.h>

#include <algorithm>
#include <random>
#include <vector>

namespace osteomill {
namespace {

using FloatImage = itk::Image<float, 3>;

std::vector<float> noise(const glm::ivec3& size) {
    std::mt19937 random(11);
    std::vector<float> values(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
                              static_cast<std::size_t>(size.z));
    for (float& value : values) value = static_cast<float>(random() % 4096) - 1024.0F;
    return values;
}

FloatImage::Pointer image_of(const glm::ivec3& size, std::vector<float>& values) {
    const auto image = FloatImage::New();
    FloatImage::SizeType itk_size;
    for (unsigned axis = 0; axis < 3; ++axis)
        itk_size[axis] = static_cast<itk::SizeValueType>(size[static_cast<int>(axis)]);
    image->SetRegions(itk_size);
    const auto container = FloatImage::PixelContainer::New();
    container->SetImportPointer(values.data(), values.size(), false);
    image->SetPixelContainer(container);
    return image;
}

/// Axes shorter and longer than the filter's memory, and one of a single voxel.
const std::vector<glm::ivec3> sizes{{40, 7, 23}, {5, 61, 2}, {3, 1, 50}};

TEST(CubicSpline, HasItksCoefficients) {
    for (const glm::ivec3& size : sizes) {
        std::vector<float> values = noise(size);
        std::vector<float> same = values;
        const auto filter = itk::BSplineDecompositionImageFilter<FloatImage, FloatImage>::New();
        filter->SetSplineOrder(3);
        filter->SetInput(image_of(size, same));
        filter->Update();
        const float* expected = filter->GetOutput()->GetBufferPointer();
        values_to_coefficients({.size_voxels = size, .spacing_mm = glm::dvec3(1.0), .values = values});
        for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], expected[i], 1e-3) << i;
    }
}

TEST(CubicSpline, SmoothsAsItkDoes) {
    const glm::ivec3 size{40, 7, 23};
    std::vector<float> values = noise(size);
    std::vector<float> same = values;
    using Gaussian = itk::DiscreteGaussianImageFilter<FloatImage, FloatImage>;
    const auto filter = Gaussian::New();
    filter->SetUseImageSpacingOff();
    Gaussian::ArrayType variance;
    constexpr double fwhm_per_sigma = 2.3548200450309493;
    variance[0] = (4.0 * 4.0 - 1.0) / (fwhm_per_sigma * fwhm_per_sigma);
    variance[1] = 0.0;
    variance[2] = (2.0 * 2.0 - 1.0) / (fwhm_per_sigma * fwhm_per_sigma);
    filter->SetVariance(variance);
    filter->SetMaximumError(0.01);
    filter->SetMaximumKernelWidth(32);
    filter->SetInput(image_of(size, same));
    filter->Update();
    const float* expected = filter->GetOutput()->GetBufferPointer();
    smooth_for_spacing({.size_voxels = size, .spacing_mm = {0.5, 2.0, 1.0}, .values = values}, 2.0);
    for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(values[i], expected[i], 1e-2) << i;
}

}  // namespace
}  // namespace osteomill
