// The cases of tests/data/milling_forces.json: steady motions over a flat half space {p . up <= 0}, up = +z,
// with mean forces from an independent quadrature (2880 x 2880 points).
#pragma once

#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill::testing {

struct ReferenceCase {
    std::string name;
    Burr burr;
    glm::dvec3 velocity_mm_per_s{0.0};
    glm::dvec3 spindle_axis{0.0, 0.0, 1.0};
    double depth_mm = 0.0;  ///< of the sphere's lowest point
    std::optional<double> previous_groove_mm_higher;
    glm::dvec3 mean_force_n{0.0};
    double removal_mm3_per_s = 0.0;
};

inline std::ostream& operator<<(std::ostream& out, const ReferenceCase& c) {
    return out << c.name;
}

inline std::vector<ReferenceCase> reference_cases() {
    std::ifstream file(OSTEOMILL_TEST_DATA "/milling_forces.json");
    const auto vec = [](const nlohmann::json& j) { return glm::dvec3(j.at(0), j.at(1), j.at(2)); };
    std::vector<ReferenceCase> cases;
    for (const auto& j : nlohmann::json::parse(file)) {
        ReferenceCase c;
        c.name = j.at("name");
        c.burr.diameter_mm = 2.0 * j.at("radius_mm").get<double>();
        c.burr.edges = j.at("edges");
        c.burr.spindle_rev_per_s = j.at("rpm").get<double>() / 60.0;
        c.burr.cutting_coefficients_n_per_mm2 = vec(j.at("K_N_mm2"));
        c.burr.sense =
            j.at("spin").get<double>() > 0.0 ? SpindleSense::counter_clockwise : SpindleSense::clockwise;
        c.velocity_mm_per_s = vec(j.at("velocity_mm_s"));
        c.spindle_axis = glm::normalize(vec(j.at("spindle_axis")));
        c.depth_mm = j.at("depth_mm");
        if (const auto& groove = j.at("previous_groove_mm_higher"); !groove.is_null())
            c.previous_groove_mm_higher = groove.get<double>();
        c.mean_force_n = vec(j.at("mean_force_N"));
        c.removal_mm3_per_s = j.at("removal_mm3_s");
        cases.push_back(c);
    }
    return cases;
}

}  // namespace osteomill::testing
