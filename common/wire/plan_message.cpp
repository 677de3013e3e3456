#include "common/wire/plan_message.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "common/bone/finite.h"
#include "common/text/plain_text.h"
#include "common/wire/vec3.h"

namespace osteomill {

v2::Plan to_message(const Plan& plan) {
    v2::Plan message;
    message.set_margin_mm(plan.margin_mm);
    if (const auto* tissue = std::get_if<TissueRegion>(&plan.region)) message.set_tissue(tissue->tissue);
    if (const auto* sphere = std::get_if<SphereRegion>(&plan.region)) {
        write(sphere->centre_mm, *message.mutable_sphere()->mutable_centre_mm());
        message.mutable_sphere()->set_radius_mm(sphere->radius_mm);
    }
    if (const auto* cylinder = std::get_if<CylinderRegion>(&plan.region)) {
        write(cylinder->from_mm, *message.mutable_cylinder()->mutable_from_mm());
        write(cylinder->to_mm, *message.mutable_cylinder()->mutable_to_mm());
        message.mutable_cylinder()->set_radius_mm(cylinder->radius_mm);
    }
    return message;
}

std::variant<Plan, WireError> plan_from(const v2::Plan& message) {
    Plan plan{.margin_mm = message.margin_mm()};
    double radius_mm = 1.0;
    switch (message.region_case()) {
        case v2::Plan::kTissue:
            plan.region = TissueRegion{printable(message.tissue())};
            break;
        case v2::Plan::kSphere: {
            const v2::Plan::Sphere& sphere = message.sphere();
            radius_mm = sphere.radius_mm();
            if (!is_finite(read(sphere.centre_mm()))) return WireError{"the plan's sphere is nowhere"};
            plan.region = SphereRegion{read(sphere.centre_mm()), radius_mm};
            break;
        }
        case v2::Plan::kCylinder: {
            const v2::Plan::Cylinder& cylinder = message.cylinder();
            radius_mm = cylinder.radius_mm();
            const glm::dvec3 from_mm = read(cylinder.from_mm());
            const glm::dvec3 to_mm = read(cylinder.to_mm());
            const double length_mm = glm::length(to_mm - from_mm);
            if (!std::isfinite(length_mm) || !(length_mm > 0.0))
                return WireError{"the plan's cylinder has an impossible length"};
            plan.region = CylinderRegion{from_mm, to_mm, radius_mm};
            break;
        }
        case v2::Plan::REGION_NOT_SET:
            return WireError{"the plan has no region"};
    }
    if (!std::isfinite(radius_mm) || !(radius_mm > 0.0) || !std::isfinite(plan.margin_mm) ||
        plan.margin_mm < 0.0)
        return WireError{"the plan has an impossible radius or margin"};
    return plan;
}

}  // namespace osteomill
