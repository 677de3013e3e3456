// The type of a scan inside the importer. Included by .cpp files of imaging alone: ITK takes long to compile.
#pragma once

#include <itkImage.h>

namespace osteomill {

/// Grey values (HU once rescaled); spacing, origin and direction in patient LPS, mm, as everywhere in ITK.
using ScanImage = itk::Image<float, 3>;

}  // namespace osteomill
