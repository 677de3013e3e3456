// Scene files: scenes read and written as TOML (scenes/*.toml are examples). Strict: an unknown, missing or
// ill-typed key and a value out of range are errors with file, line and the valid choices; a default never
// silently replaces a written value.
//
//     name = "jaw"
//     start_burr = "1.5 mm"
//     wall_friction = 0.2
//     [bone]           phantom = "tooth"   or   file = "jaw.nrrd", threshold_hu = 300.0
//     [stiffness]      knots = [[150, 0.02], [1600, 1.0], ...]: HU, relative stiffness
//     [[tissues]]      label = 1, name = "enamel", colour = "#f6f4ec", protected = false,
//                      material = "enamel", and of what it says relative_stiffness = 3.0,
//                      relative_edge = 3.0 in its place, or these without it; stiffness_factor = 1.2;
//                      cuttable = false
//     [[burrs]]        name, diameter_mm, edges, rpm, cutting_coefficients_n_per_mm2 = [K_t, K_r, K_a],
//                      edge_coefficients_n_per_mm = [K_te, K_re, K_ae],
//                      turns = "clockwise", shank = [[height_mm, radius_mm], ...]
//     [coupling]       feed_forward = false
//     [device]         rotation = [[..], [..], [..]] (rows), scale, offset_mm
//     [start_pose]     position_mm, spindle_axis
//     [trajectory]     motion = "hold" | "polishing" | "cavity"   or   file = "path.csv";
//                      start_mm, travel_direction, speed_mm_per_s, depth_mm, width_mm
//     [plan]           tissue = "carious lesion"   or   sphere = { centre_mm, radius_mm }   or
//                      cylinder = { from_mm, to_mm, radius_mm }; margin_mm
//     [[fixture]]      name, kind = "guide" | "forbidden" | "slow", on = true;
//                      line = { from_mm, to_mm } or plane = { at_mm, normal }, radius_mm, reach_mm   or
//                      tissue = "pulp", distance_mm; fade_mm, stiffness_n_per_mm, damping_n_s_per_m,
//                      max_force_n, spindle_share
//     [pass]           time_s, plan_removed_share, plan_excess_mm3, structure_touches, peak_force_n
//
// Paths are relative to the scene file. Only name and [bone] are required; all else has the defaults of
// scene.h and the usual burr set at 10 000 rpm.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/scene/scene.h"
#include "common/scene/scene_change.h"

namespace osteomill {

/// One line, printable (foreign_text.h): "file:line: what is wrong; what would be right".
class SceneError : public std::runtime_error {
  public:
    explicit SceneError(const std::string& message);
};

/// Throws SceneError for an unreadable file or a bad scene; if a change is to blame, "OPTION: what is wrong".
Scene read_scene(const std::filesystem::path& path, const SceneChanges& changes = {});

/// As read_scene, from text. `name_for_messages` stands in messages; relative paths are resolved against
/// `folder`.
Scene parse_scene(std::string_view text, const std::string& name_for_messages,
                  const std::filesystem::path& folder = {}, const SceneChanges& changes = {});

/// Extent of a written scene: the keys that differ from the defaults, or every key that has a value.
enum class SceneText { concise, complete };

/// The scene as TOML for people: a line of comment before each block, every number in the fewest digits that
/// read back as it. parse_scene gives the same scene back. In scene_writer.cpp.
std::string write_scene(const Scene& scene, SceneText extent = SceneText::concise);

}  // namespace osteomill
