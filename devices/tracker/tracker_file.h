// The file of --tracker-registration (TOML): how a tracked handpiece stands to its marker, where its pedal
// comes from, and the pairs of points that place the tracker's space on the patient.
//
//     [tool]                              # in the marker's frame, as its TRANSFORM has it
//     burr_centre_mm = [0, 0, 150]
//     spindle_axis = [0, 0, -1]           # from the burr's tip to the shank
//     [pedal]
//     string = "Pedal"                    # the name of a STRING message; or: always = true
//     [registration]
//     largest_residual_mm = 2             # default
//     [[points]]
//     name = "mastoid tip"
//     tracker_mm = [102.1, -33.0, -1204.8]
//     patient_mm = [57.2, 21.9, -40.3]    # LPS
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "devices/tracker/point_registration.h"

namespace osteomill {

/// A tracked handpiece, in its marker's frame.
struct TrackedHandpiece {
    glm::dvec3 burr_centre_mm{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};  ///< unit vector from tip to shank
    std::string pedal;                       ///< the device name of STRING messages; empty: always down
};

struct TrackerSetup {
    TrackedHandpiece handpiece;
    PointRegistration registration;
    std::vector<PointPair> points;
};

/// Throws std::runtime_error in one line, with the file and, if known, the line in it, for entries that are
/// missing, wrong or out of range, and for pairs that registered() refuses.
TrackerSetup parse_tracker_setup(std::string_view toml, const std::string& name);
TrackerSetup read_tracker_setup(const std::filesystem::path& path);

/// "registered by 4 points: residual 0.31 mm (rms), 0.52 mm at the most, at 'mastoid tip'"
std::string residual_line(const TrackerSetup& setup);

}  // namespace osteomill
