// Metrics of each protected structure: harm to it, how bare it lies, and how the trainee cut near it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"

namespace osteomill {

/// Harm to each protected structure: how near the burr came, when and how long it touched, and how much of
/// the structure is gone. NearnessMetrics: how the trainee cuts near one; ExposureMetrics: how much of
/// one lies bare.
///
/// A structure is where the recording says it is, or else where the bone has its tissue's label. Distances
/// are from the burr's head, whatever its shape, to the structure, at the states of the recording
/// (structure_watch.h): the very numbers of the live session.
struct StructureMetrics {
    std::string name;
    std::optional<double> nearest_mm{};  ///< 0 once touched; nothing: never within watched_mm(), or nowhere
    std::size_t touches = 0;             ///< spells in which the burr overlapped it or took of it
    std::optional<double> first_touch_s{};
    double touched_s = 0.0;        ///< in all
    double dose_mm3 = 0.0;         ///< bone of it that is gone at the end
    double undone_dose_mm3 = 0.0;  ///< that was milled and given back
    double entered_mm3 = 0.0;      ///< voxels of it, bone or not, that the burr's head entered
};

/// Metrics of every protected tissue of the scene.
std::vector<StructureMetrics> structure_metrics(const SessionTrace& trace);

// Exposure of each protected structure: the shares of its surface that lie bare, or under thin bone, after
// bone was removed. StructureMetrics: whether the structure itself was milled, "Opened" in the report.
//
// The surface consists of the structure's voxels that share a face with a voxel outside of it. The bone over
// such a voxel is as thick as the straight distance from it to the nearest voxel of the cavity (voxel_set.h),
// from face to face: the distance of their centres less one voxel. It counts only if this line leaves the
// structure within two voxels; a line through the structure leads to its far side, where nothing was exposed.
// Air that was there before counts neither as bone nor as an opening. A voxel of the surface that is cavity
// itself is bare.
//
// Shares are of area. A voxel's area, in faces, is the square root of the number of axes along which it has a
// free face, as a slanted surface has it; it is 8 % too large at worst, on a surface that leans by 27
// degrees.

inline constexpr std::array<double, 3> thin_mm{0.5, 1.0, 2.0};

struct ExposureMetrics {
    std::string name;
    double bare_share = 0.0;                          ///< without any bone over it
    std::array<double, thin_mm.size()> thin_share{};  ///< under less than thin_mm of bone
};

/// The exposure of each structure that is somewhere, in the scene's order, at the end of the session.
std::vector<ExposureMetrics> exposure_metrics(const SessionTrace& trace);

// Cutting near each protected structure, compared with the same trainee elsewhere: force, feed, and where the
// strokes lead. StructureMetrics: whether it was touched.
//
// The distance from the burr's head to the structure (structure_watch.h) decides what is near, state by
// state; elsewhere is further than 3 mm from every protected structure. A stroke's path within the 3 mm is
// divided into pieces: consecutive frames that cut, until the burr is 0.5 mm from where the piece began. A
// shorter remainder is left out. A piece leads toward the structure if the distance falls by more than cos 45
// degrees of the piece's length, away if it rises by as much, else along.

inline constexpr std::array<int, 3> near_mm{1, 2, 3};

/// While bone was cut.
struct ForceAndFeed {
    double time_s = 0.0;
    std::optional<double> force_n{};        ///< mean over time; nothing: no time
    std::optional<double> feed_mm_per_s{};  ///< path of the burr over time
};

struct NearStructure {
    std::string name;
    std::array<ForceAndFeed, near_mm.size()> within{};  ///< near_mm; the wider hold the narrower
    double toward_mm = 0.0;                             ///< length of the pieces
    double along_mm = 0.0;
    double away_mm = 0.0;

    /// A share of all pieces; nothing if there are none.
    std::optional<double> toward_share() const;
};

struct NearnessMetrics {
    ForceAndFeed elsewhere{};
    std::vector<NearStructure> structures{};  ///< near which bone was cut; as the scene lists them
};

NearnessMetrics nearness_metrics(const SessionTrace& trace);

}  // namespace osteomill
