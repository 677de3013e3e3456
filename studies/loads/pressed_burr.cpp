#include "studies/loads/pressed_burr.h"

#include <cmath>
#include <memory>

#include "simulation/coupling/burr_proxy.h"
#include "simulation/force_models/milling_model.h"
#include "studies/force/bone_block.h"

namespace osteomill::study {

namespace {

constexpr double tick_s = 0.001;
constexpr double voxel_mm = 0.05;
/// Stiff enough that the guide, and not the edges' pull aside, says where the burr goes.
constexpr double guide_n_per_mm = 15.0;
const glm::dvec3 up(0.0, 0.0, 1.0);

}  // namespace

PressedResult press(const PressedStroke& stroke) {
    Burr burr = stroke.burr;
    burr.cutting_coefficients_n_per_mm2 *= stroke.material.relative_stiffness;
    burr.edge_coefficients_n_per_mm *= stroke.material.relative_edge;
    const double radius_mm = burr.radius_mm();
    const double margin_mm = radius_mm + 1.0;
    MillingModel model(voxelised({.low_mm = {-margin_mm, -margin_mm, -2.0 * radius_mm},
                                  .high_mm = {stroke.length_mm + margin_mm, margin_mm, 0.0}},
                                 voxel_mm),
                       {burr}, {});
    ForgottenChanges changes;
    const auto latest = std::make_unique<MillingResult>();
    double now_s = 0.0;
    const auto mill = [&](const glm::dvec3& position_mm) {
        now_s += tick_s;
        model.step({.pose = {position_mm, up}, .spindle_on = true, .elapsed_s = tick_s}, now_s, changes,
                   *latest);
    };
    BurrProxy proxy;
    proxy.place({0.0, 0.0, radius_mm + 0.02});
    mill(proxy.position_mm());

    PressedResult result;
    const int ticks = static_cast<int>(std::lround(stroke.length_mm / (stroke.feed_mm_per_s * tick_s)));
    const int measured_from = 2 * ticks / 3;
    for (int tick = 1; tick <= ticks; ++tick) {
        // Below the burr by what makes the spring pull with the load, wherever the burr is.
        const glm::dvec3 hand_mm(tick * tick_s * stroke.feed_mm_per_s, 0.0,
                                 proxy.position_mm().z - stroke.load_n / guide_n_per_mm);
        proxy.advance(hand_mm, hand_mm, {guide_n_per_mm * (hand_mm - proxy.position_mm()), guide_n_per_mm},
                      tick_s, true, *latest);
        mill(proxy.carving_mm());
        if (radius_mm - proxy.position_mm().z > 0.9 * radius_mm) return {.sinks = true};
        if (tick <= measured_from) continue;
        result.removal_mm3_per_s += latest->removed_mm3 / (tick_s * (ticks - measured_from));
        result.depth_mm += (radius_mm - proxy.position_mm().z) / (ticks - measured_from);
    }
    return result;
}

}  // namespace osteomill::study
