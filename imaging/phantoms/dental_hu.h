// CT numbers of the tissues of teeth and jaws.
#pragma once

namespace osteomill {

// Enamel, dentine and pulp as measured in children's teeth (2071 to 2955, 1323 to 1899, 184 to 420 HU); the
// lesion lies well below dentine.
inline constexpr double enamel_hu = 2500.0;
inline constexpr double dentine_hu = 1600.0;
inline constexpr double pulp_hu = 300.0;
inline constexpr double lesion_hu = 650.0;
inline constexpr double cortical_hu = 1600.0;
inline constexpr double ligament_hu = 60.0;
// In life they are below the threshold of bone; here just above it, so that they exist.
inline constexpr double nerve_hu = 190.0;
inline constexpr double gum_hu = 170.0;

}  // namespace osteomill
