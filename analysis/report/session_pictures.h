// The pictures of a report: sections through target and nearest approach; the place of work before and after,
// and at each mark, always from the same views.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/report/session_trace.h"
#include "common/program/progress.h"

namespace osteomill {

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
