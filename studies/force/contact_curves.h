// The older contact models beside the milling force: what each feels of a burr that rests in flat bone.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/table.h"

namespace osteomill::study {

struct ContactRow {
    double depth_mm = 0.0;
    std::vector<double> force_n{};  ///< by model, length of the vector
    std::vector<double>
        milling_force_n{};  ///< by feed, the analytical reference of a fresh slot of that depth
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ContactRow, depth_mm, force_n, milling_force_n)

/// Of force_models.h, those that know no cutting law.
std::vector<std::string> contact_models();
std::vector<double> contact_depths_mm(bool quick);

/// Length of the force that a model feels of such a burr, N.
double resting_force_n(const std::string& model, double depth_mm);

/// A 5 mm burr, upright, spindle off, over 0.1 mm voxels; the milling force at 10 000 rpm.
ContactRow measure_contact(double depth_mm);

/// depth_mm, a column a model, a column a feed ("milling 6 mm/s").
Table table_of(const std::vector<ContactRow>& rows);

}  // namespace osteomill::study
