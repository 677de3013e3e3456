#include "studies/states/milled_path.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>

#include "common/bone/patient_space.h"
#include "common/scene/burr.h"
#include "common/sound/burr_sound.h"
#include "simulation/coupling/handpiece_vibration.h"
#include "simulation/device/haptic_device.h"
#include "simulation/engagement/engagement.h"
#include "simulation/force_models/milling_model.h"
#include "simulation/loop/cut_report.h"
#include "simulation/loop/spindle_torque.h"
#include "simulation/safety/force_guard.h"

namespace osteomill::study {

namespace {

/// A patch is a sixteenth of a ring about the spindle wide, over which chips go from none to thick: each is
/// taken in so many parts, side by side, that have its gap.
constexpr int parts_of_patch = 6;
constexpr double share_of_part = 1.0 / parts_of_patch;
constexpr double patch_rad = 2.0 * std::numbers::pi / 16.0;
/// Waves a turn that the ends of bone, seen by whole patches, still show.
constexpr int most_waves_a_turn = 30;
constexpr std::size_t sound_samples = static_cast<std::size_t>(BurrSound::rate_hz * path_step_s);

void push(std::vector<double>& column, const glm::dvec3& v) {
    column.insert(column.end(), {v.x, v.y, v.z});
}

/// From a patch's middle to one of its parts.
struct Turn {
    glm::dmat3 by{1.0};
    std::complex<double> tooth = 1.0;  // exp(-i N angle)
};

std::array<Turn, parts_of_patch> turns_about(const glm::dvec3& axis, int edges) {
    std::array<Turn, parts_of_patch> turns;
    const glm::dmat3 cross(0.0, axis.z, -axis.y, -axis.z, 0.0, axis.x, axis.y, -axis.x, 0.0);
    for (int i = 0; i < parts_of_patch; ++i) {
        const double angle = patch_rad * ((i + 0.5) / parts_of_patch - 0.5);
        turns[static_cast<std::size_t>(i)] = {
            glm::dmat3(1.0) + std::sin(angle) * cross + (1.0 - std::cos(angle)) * (cross * cross),
            std::polar(1.0, -edges * angle)};
    }
    return turns;
}

class PathMill {
  public:
    PathMill(const Scene& scene, Bone bone, std::size_t burr)
        : burrs_(felt_burrs(scene)),
          burr_(burr),
          model_(std::move(bone), burrs_, scene.tissues),
          vibration_(burrs_, {.max_force_n = DeviceLimits{}.max_force_n,
                              .max_slew_n_per_s = ForceGuard::slew_n_per_s,
                              .scale = ArmScale(scene.device.scale)}),
          cut_(burrs_, scene.motor) {
        milled_.harmonics = harmonics_of(burrs_[burr_]);
    }

    void put_down(const PathStep& at) {
        move(at.pose, false);
        move(at.pose, at.spindle_on);
        from_mm_ = at.pose.position_mm;
    }

    void step(const PathStep& to) {
        move(to.pose, to.spindle_on);
        feed_mm_per_s_ = (to.pose.position_mm - from_mm_) / path_step_s;
        from_mm_ = to.pose.position_mm;
        look_at_patches(to);
        push(milled_.model_force_n, result_->force_n);
        milled_.removed_mm3.push_back(result_->removed_mm3);
        shake(to);
        sound();
    }

    MilledPath milled() && { return std::move(milled_); }

  private:
    void move(const ToolPose& pose, bool spindle_on) {
        time_s_ += path_step_s;
        model_.step({.pose = pose, .spindle_on = spindle_on, .burr = burr_, .elapsed_s = path_step_s},
                    time_s_, changes_, *result_);
        if (!result_->valid) throw std::invalid_argument("a pose of the path is not finite");
    }

    void look_at_patches(const PathStep& to) {
        const Burr& burr = burrs_[burr_];
        const Engagement& map = result_->engagement;
        const glm::dmat3 frame = burr_frame(to.pose.spindle_axis);
        const std::array<Turn, parts_of_patch> turns = turns_about(frame[2], burr.edges);
        const auto harmonics = static_cast<std::size_t>(milled_.harmonics);
        std::vector<std::complex<double>> waves(3 * harmonics);
        glm::dvec3 force_n(0.0);
        glm::dvec3 area_by_normal(0.0);
        double touching_mm2 = 0.0;
        double cutting_mm2 = 0.0;
        double stiffness_n = 0.0;
        double weight_n = 0.0;
        for (const EngagedPatch& patch : std::span(map.patches).first(map.count)) {
            if (patch.gap_mm > touching_voxels * map.spacing_mm) continue;
            touching_mm2 += patch.area_mm2;
            if (!to.spindle_on || patch.is_wall) continue;
            const double area_mm2 = share_of_part * patch.area_mm2;
            const double out = std::hypot(glm::dot(patch.normal, frame[0]), glm::dot(patch.normal, frame[1]));
            const double stiffness = patch_stiffness(patch, burr, patch_lever_mm(burr, out));
            const double psi = std::atan2(glm::dot(patch.normal, frame[1]), glm::dot(patch.normal, frame[0]));
            const std::complex<double> middle = std::polar(1.0, -burr.edges * psi);
            for (const Turn& turn : turns) {
                const glm::dvec3 normal = turn.by * patch.normal;
                const double advance_mm_per_s = glm::dot(normal, feed_mm_per_s_);
                if (advance_mm_per_s <= 0.0) continue;
                const glm::dvec3 chip_n =
                    share_of_part * advance_mm_per_s * (turn.by * patch.cutting_n_s_per_mm);
                const glm::dvec3 cut_n = chip_n + share_of_part * (turn.by * patch.edge_n);
                force_n += cut_n;
                area_by_normal += area_mm2 * normal;
                cutting_mm2 += area_mm2;
                weight_n += glm::length(chip_n);
                stiffness_n += glm::length(chip_n) * stiffness;
                const std::complex<double> tooth = middle * turn.tooth;
                std::complex<double> wave = tooth;
                for (std::size_t k = 0; k < harmonics; ++k, wave *= tooth)
                    for (int axis = 0; axis < 3; ++axis)
                        waves[3 * k + static_cast<std::size_t>(axis)] += cut_n[axis] * wave;
            }
        }
        push(milled_.force_n, force_n);
        milled_.harmonic_n.insert(milled_.harmonic_n.end(), waves.begin(), waves.end());
        milled_.engaged_mm2.push_back(touching_mm2);
        milled_.relative_stiffness.push_back(weight_n > 0.0 ? stiffness_n / weight_n : 0.0);
        push(milled_.normal, cutting_mm2 > 0.0 ? area_by_normal / cutting_mm2 : glm::dvec3(0.0));
    }

    void shake(const PathStep& to) {
        push(milled_.vibration_n, vibration_.tick({.now_s = time_s_,
                                                   .tick_s = path_step_s,
                                                   .pose = to.pose,
                                                   .velocity_mm_per_s = feed_mm_per_s_,
                                                   .spindle_on = to.spindle_on,
                                                   .burr = burr_},
                                                  *result_, result_->force_n, true));
    }

    void sound() {
        cut_.add(*result_, path_step_s);
        if (cut_.is_due()) heard_ = cut_.take(*result_, 1.0);
        sound_.hear(cue_of({.burr = burr_, .spindle_on = result_->spindle_on, .cut = heard_}, burrs_[burr_]));
        std::array<float, sound_samples> samples;
        sound_.render(samples);
        milled_.sound.insert(milled_.sound.end(), samples.begin(), samples.end());
    }

    std::vector<Burr> burrs_;
    std::size_t burr_;
    MillingModel model_;
    ForgottenChanges changes_;
    std::unique_ptr<MillingResult> result_ = std::make_unique<MillingResult>();  // too large for a stack
    HandpieceVibration vibration_;
    CutReport cut_;
    std::optional<CutState> heard_{};
    BurrSound sound_;
    double time_s_ = 0.0;
    glm::dvec3 from_mm_{0.0};
    glm::dvec3 feed_mm_per_s_{0.0};
    MilledPath milled_;
};

}  // namespace

int harmonics_of(const Burr& burr) {
    return most_waves_a_turn / burr.edges;
}

MilledPath mill_path(const Scene& scene, Bone bone, std::size_t burr, const std::vector<PathStep>& path) {
    if (path.size() < 2) throw std::invalid_argument("a path has at least two poses");
    if (burr >= scene.burrs.size()) throw std::invalid_argument("the scene has no such burr");
    for (const PathStep& step : path)
        if (!is_finite(step.pose.position_mm))
            throw std::invalid_argument("a pose of the path is not finite");
    PathMill mill(scene, std::move(bone), burr);
    mill.put_down(path.front());
    for (const PathStep& step : std::span(path).subspan(1)) mill.step(step);
    return std::move(mill).milled();
}

}  // namespace osteomill::study
