// Cameras of an image set, from a TOML file:
//
//     [[cameras]]
//     name = "left"                     # a folder's name: letters, digits, - and _
//     width_px = 640                    # the default
//     height_px = 480                   # the default
//     intrinsics = [[800, 0, 319.5], [0, 800, 239.5], [0, 0, 1]]   # default: 34 degrees from top to bottom
//     eye_mm = [10, -80, 60]            # patient LPS
//     target_mm = [0, 0, 0]
//     up = [0, 0, 1]                    # the default
//     path = "path.csv"                 # in place of eye, target and up: time_s,x,y,z,qx,qy,qz,qw a line
//     view = "trainee"                  # in place of those: from where the trainee looked, as recorded
//     baseline_mm = 5                   # a pair, NAME_left and NAME_right, about that pose
//     convergence_mm = 100              # where both pictures show the same; default: nowhere, axes parallel
//
// A path's poses are the camera's axes (right, down, forward) in patient LPS by recorded time; between lines
// they are interpolated, before the first and behind the last they stay. A camera without a pose has the
// first view of the session, as a window has it. So has a trainee's before that is recorded; without
// intrinsics it has the trainee's angle, from top to bottom, which may change from frame to frame.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/session/viewpoint.h"
#include "render_client/dataset/pinhole.h"

namespace osteomill {

struct DatasetCamera {
    std::string name = "view";
    Pinhole pinhole{};
    std::vector<double> times_s{};  ///< ascending
    std::vector<Pose> poses{};      ///< at those; one where it stands still, none: the first view
    double aside_mm = 0.0;          ///< how far to the right of that pose: one of a pair
    double aside_slope = 0.0;       ///< the shift of the picture's middle by that: mm a mm forward
    bool follows_trainee = false;   ///< in place of those poses
    bool has_trainees_angle = false;

    /// `trainee`: from where they look then, if that is recorded.
    Pose pose_at(double time_s, const Pose& first_view, const std::optional<Viewpoint>& trainee = {}) const;
    /// The value of `pinhole` for that viewpoint.
    Pinhole pinhole_at(const std::optional<Viewpoint>& trainee) const;
};

/// One, at the first view.
std::vector<DatasetCamera> default_cameras();

/// Throws std::runtime_error, in one line, for bad contents. A path's file is relative to the cameras' file.
std::vector<DatasetCamera> read_cameras(const std::filesystem::path& file);
/// The text of such a file; `name` is its name in errors, and paths are relative to `folder`.
std::vector<DatasetCamera> parse_cameras(std::string_view text, const std::string& name,
                                         const std::filesystem::path& folder);

/// Throws std::runtime_error, in one line, if one follows a trainee and the recording has no such view.
/// `has_view` is called only if a camera follows the trainee, since it may have to read the whole recording.
void require_view(std::span<const DatasetCamera> cameras, const std::function<bool()>& has_view,
                  const std::filesystem::path& recording);

/// "trainee": one of that name, which follows the trainee; empty: the default; else a file's.
std::vector<DatasetCamera> cameras_named(const std::string& which);

}  // namespace osteomill
