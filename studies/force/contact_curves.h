// The older contact models beside the milling force: what each feels of a burr that rests in flat bone.
#pragma once

#include <string>
#include <vector>

#include "analysis/output/table.h"
#include "common/program/progress.h"

namespace osteomill::study {

struct ContactRow {
    double depth_mm = 0.0;
    std::vector<double> force_n{};  ///< by model, length of the vector
    std::vector<double>
        milling_force_n{};  ///< by feed, the analytical reference of a fresh slot of that depth
};

struct ContactCurves {
    std::vector<std::string> models{};  ///< of force_models.h, those that know no cutting law
    std::vector<double> feeds_mm_per_s{};
    std::vector<ContactRow> rows{};
    std::vector<double>
        step_us{};  ///< by model, median of a burr that slides 1 mm deep with the spindle on, 1 kHz
};

/// A 5 mm burr, upright, spindle off, over 0.1 mm voxels; the milling force at 10 000 rpm.
ContactCurves measure_contact(bool quick, const ReportProgress& progress);

/// depth_mm, a column a model, a column a feed ("milling 6 mm/s").
Table table_of(const ContactCurves& curves);

}  // namespace osteomill::study
