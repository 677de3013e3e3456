#include "simulation/cutting_force/reference_force.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "common/scene/burr.h"
#include "common/scene/burr_profile.h"

namespace osteomill::study {

namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;

/// One point of the burr's surface, patient axes.
struct SurfacePoint {
    glm::dvec3 arm_mm;  ///< from the burr's origin
    glm::dvec3 normal;
    glm::dvec3 e_psi;
    glm::dvec3 e_kappa;
    double radius_mm;  ///< from the spindle
};

/// The outline of a burr's head, by the length along it from the tip.
class Outline {
  public:
    explicit Outline(const Burr& burr) : ball_radius_mm_(burr.radius_mm()) {
        if (!burr.is_ball()) profile_.emplace(burr.head, burr.diameter_mm);
    }

    double length_mm() const {
        return profile_ ? profile_->outline_length() : std::numbers::pi * ball_radius_mm_;
    }

    SurfacePoint point(const glm::dmat3& frame, double along_mm, double psi) const {
        const OutlinePoint at = profile_ ? profile_->outline_at(along_mm) : on_ball(along_mm);
        const double sp = std::sin(psi);
        const double cp = std::cos(psi);
        return {.arm_mm = frame * glm::dvec3(cp * at.radius, sp * at.radius, at.height),
                .normal = frame * glm::dvec3(cp * at.out, sp * at.out, at.up),
                .e_psi = frame * glm::dvec3(-sp, cp, 0.0),
                .e_kappa = frame * glm::dvec3(-cp * at.up, -sp * at.up, at.out),
                .radius_mm = at.radius};
    }

  private:
    OutlinePoint on_ball(double along_mm) const {
        const double kappa = along_mm / ball_radius_mm_;
        const double out = std::sin(kappa);
        const double up = -std::cos(kappa);
        return {ball_radius_mm_ * out, ball_radius_mm_ * up, out, up};
    }

    double ball_radius_mm_;
    std::optional<BurrProfile> profile_{};
};

/// Force on the burr for each mm of an edge's length at a point: chip and edge forces. t dz = f_t (n . v/|v|)
/// ds.
glm::dvec3 force_per_edge_length(const SteadyMotion& motion, const SurfacePoint& point, double stiffness,
                                 double feed_per_tooth_mm, const glm::dvec3& direction) {
    const double chip_mm = feed_per_tooth_mm * std::max(0.0, glm::dot(point.normal, direction));
    if (chip_mm <= 0.0 || stiffness <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 per_length = stiffness * (motion.burr.cutting_coefficients_n_per_mm2 * chip_mm +
                                               motion.burr.edge_coefficients_n_per_mm);
    return -(motion.burr.sigma() * per_length.x * point.e_psi + per_length.y * point.normal +
             per_length.z * point.e_kappa);
}

double feed_per_tooth_mm(const SteadyMotion& motion) {
    return glm::length(motion.velocity_mm_per_s) / (motion.burr.edges * motion.burr.spindle_rev_per_s);
}

/// Integrates along the outline from tip to shank: calls `visit(point, stiffness, ds)` for each part of a
/// cell. `psi_at` gives the psi of a point of the outline. If the bone changes within a cell, the edge is
/// found by bisection and the cell is split there: without that a sum over 1440 cells is no better than 0.2
/// %.
template <typename PsiAt, typename Visit>
void along_outline(const SteadyMotion& motion, const glm::dmat3& frame, const BoneFunction& bone, int cells,
                   PsiAt&& psi_at, Visit&& visit) {
    const Outline outline(motion.burr);
    const auto point_at = [&](double along_mm) { return outline.point(frame, along_mm, psi_at(along_mm)); };
    const auto stiffness_at = [&](double along_mm) {
        return bone(motion.position_mm + point_at(along_mm).arm_mm);
    };
    const auto visit_part = [&](double from, double to) {
        if (to <= from) return;
        const double middle = 0.5 * (from + to);
        const double stiffness = stiffness_at(middle);
        if (stiffness > 0.0) visit(point_at(middle), stiffness, to - from);
    };
    constexpr int bisections = 24;
    double from = 0.0;
    double stiffness_from = stiffness_at(from);
    for (int cell = 0; cell < cells; ++cell) {
        const double to = outline.length_mm() * (cell + 1) / cells;
        const double stiffness_to = stiffness_at(to);
        if (stiffness_from == stiffness_to) {
            visit_part(from, to);
        } else {
            double low = from;
            double high = to;
            for (int i = 0; i < bisections; ++i) {
                const double middle = 0.5 * (low + high);
                (stiffness_at(middle) == stiffness_from ? low : high) = middle;
            }
            visit_part(from, low);
            visit_part(high, to);
        }
        from = to;
        stiffness_from = stiffness_to;
    }
}

/// Calls `take` with the force on each part of one edge at each psi, and returns the share that each has in a
/// mean: each edge is at every psi for an equal share of a revolution; helix lag shifts that, not the mean.
template <typename Take>
double over_a_turn(const SteadyMotion& motion, const BoneFunction& bone, const Quadrature& quadrature,
                   Take&& take) {
    const double speed = glm::length(motion.velocity_mm_per_s);
    if (speed == 0.0) return 0.0;
    const glm::dmat3 frame = burr_frame(motion.spindle_axis);
    const glm::dvec3 direction = motion.velocity_mm_per_s / speed;
    const double feed = feed_per_tooth_mm(motion);
    for (int j = 0; j < quadrature.psi; ++j) {
        const double psi = turn_rad * (j + 0.5) / quadrature.psi;
        along_outline(
            motion, frame, bone, quadrature.kappa, [&](double) { return psi; },
            [&](const SurfacePoint& point, double stiffness, double ds_mm) {
                take(ds_mm * force_per_edge_length(motion, point, stiffness, feed, direction));
            });
    }
    return static_cast<double>(motion.burr.edges) / quadrature.psi;
}

}  // namespace

double mean_reference_parts_n(const SteadyMotion& motion, const BoneFunction& bone,
                              const Quadrature& quadrature) {
    double sum = 0.0;
    const double share =
        over_a_turn(motion, bone, quadrature, [&](const glm::dvec3& part_n) { sum += glm::length(part_n); });
    return sum * share;
}

glm::dvec3 mean_reference_force_n(const SteadyMotion& motion, const BoneFunction& bone,
                                  const Quadrature& quadrature) {
    glm::dvec3 sum(0.0);
    const double share =
        over_a_turn(motion, bone, quadrature, [&](const glm::dvec3& part_n) { sum += part_n; });
    return sum * share;
}

glm::dvec3 instantaneous_reference_force_n(const SteadyMotion& motion, const BoneFunction& bone,
                                           double turned_rad, double helix_lag_rad_per_mm,
                                           const Quadrature& quadrature) {
    const double speed = glm::length(motion.velocity_mm_per_s);
    if (speed == 0.0) return glm::dvec3(0.0);
    const glm::dmat3 frame = burr_frame(motion.spindle_axis);
    const glm::dvec3 direction = motion.velocity_mm_per_s / speed;
    const double feed = feed_per_tooth_mm(motion);
    const Outline outline(motion.burr);
    const double tip_mm = outline.point(glm::dmat3(1.0), 0.0, 0.0).arm_mm.z;
    glm::dvec3 sum(0.0);
    for (int edge = 0; edge < motion.burr.edges; ++edge) {
        const auto psi_at = [&](double along_mm) {
            const double above_tip_mm = outline.point(glm::dmat3(1.0), along_mm, 0.0).arm_mm.z - tip_mm;
            return motion.burr.sigma() *
                   (turned_rad - helix_lag_rad_per_mm * above_tip_mm + turn_rad * edge / motion.burr.edges);
        };
        along_outline(motion, frame, bone, quadrature.kappa, psi_at,
                      [&](const SurfacePoint& point, double stiffness, double ds_mm) {
                          sum += ds_mm * force_per_edge_length(motion, point, stiffness, feed, direction);
                      });
    }
    return sum;
}

double reference_removal_mm3_per_s(const SteadyMotion& motion, const BoneFunction& bone,
                                   const Quadrature& quadrature) {
    const glm::dmat3 frame = burr_frame(motion.spindle_axis);
    double sum = 0.0;
    for (int j = 0; j < quadrature.psi; ++j) {
        const double psi = turn_rad * (j + 0.5) / quadrature.psi;
        along_outline(
            motion, frame, bone, quadrature.kappa, [&](double) { return psi; },
            [&](const SurfacePoint& point, double, double ds_mm) {
                sum +=
                    ds_mm * point.radius_mm * std::max(0.0, glm::dot(point.normal, motion.velocity_mm_per_s));
            });
    }
    return sum * turn_rad / quadrature.psi;
}

BoneFunction flat_bone() {
    return [](const glm::dvec3& p) { return p.z <= 0.0 ? 1.0 : 0.0; };
}

BoneFunction flat_bone_with_groove(const glm::dvec3& position_mm, const glm::dvec3& direction,
                                   double radius_mm) {
    return [=](const glm::dvec3& p) {
        if (p.z > 0.0) return 0.0;
        const glm::dvec3 w = p - position_mm;
        const glm::dvec3 across = w - glm::dot(w, direction) * direction;
        return glm::length(across) > radius_mm ? 1.0 : 0.0;
    };
}

}  // namespace osteomill::study
