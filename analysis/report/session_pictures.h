// The pictures of a report: sections through target and nearest approach; the place of work before and after,
// and at each mark, always from the same views.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/report/planned_region.h"
#include "analysis/report/session_trace.h"
#include "common/program/progress.h"
#include "imaging/picture/bone_picture.h"

namespace osteomill {

/// Views of a report's pictures: at the place of work, through the target, through the nearest approach to a
/// protected structure.
struct NamedView {
    std::string title;
    BoneView view;
};

/// From the handpiece, and two sections, of all that was planned and removed, or of all bone if there is
/// neither. Empty if there is no bone. `region`: of the session's plan, null without one.
std::vector<NamedView> views_of_work(const SessionTrace& trace, const PlannedRegion* region);

/// The burr's nearest approach to a protected structure.
struct NearestApproach {
    std::string structure;
    const TraceSample* sample = nullptr;  ///< of the trace, when it was there
    double distance_mm = 0.0;             ///< between burr's head and structure; 0: they touched
    glm::dvec3 structure_mm{0.0};         ///< the structure's voxel that is nearest to the burr's centre
};

/// Nothing if the burr was never within watched_mm() of any.
std::optional<NearestApproach> nearest_approach(const SessionTrace& trace);

/// The anatomical section through the middle of the plan, or of the work if there is none, whose plane comes
/// nearest to holding the handpiece.
std::optional<NamedView> view_of_target(const SessionTrace& trace, const PlannedRegion* region);
/// The section through burr and structure.
NamedView view_of(const NearestApproach& approach, double burr_diameter_mm);

struct ReportPicture {
    std::string title{};
    std::string png_uri{};
    std::string overlay{};  ///< SVG, to lie over it
};

struct SessionPictures {
    std::vector<ReportPicture> first{};   ///< two, at the end, larger than the others
    std::vector<ReportPicture> before{};  ///< from each view
    std::vector<ReportPicture> after{};   ///< from the same
    std::vector<ReportPicture> marks{};   ///< from the first view
    std::size_t marks_left_out = 0;
};

/// Reads the recording again for the bone at each mark, if there is one. `on_frame`: see read_trace.
SessionPictures session_pictures(const std::filesystem::path& file, const SessionTrace& trace,
                                 const ReportProgress& on_frame);

/// HTML: pictures with their overlays, side by side. `kind`: of .pictures in page_style.
std::string figures(const std::vector<ReportPicture>& pictures, const char* kind = "");

}  // namespace osteomill
