#include "studies/stability/map/truth.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "studies/stability/map/swept_bone.h"

namespace osteomill::study {
namespace {

/// A tool whose force in a substep depends on where the substep ends.
class Truth {
  public:
    virtual ~Truth() = default;
    virtual void substep(double time_s, double substep_s) = 0;
    virtual void every_tick() {}
    TruthTick now() const { return {tool_.position_mm, burr_mm_, force_n_}; }

  protected:
    explicit Truth(const ScenePlan& plan)
        : plan_(plan),
          tool_(plan.at_release),
          burr_mm_(plan.burr_at_release_mm),
          force_n_(plan.steady_force_n) {}

    OpenStep open(double time_s, double substep_s) const {
        return open_step(plan_.tool, plan_.intent, tool_, time_s, substep_s);
    }
    void move_tool(const glm::dvec3& velocity_mm_per_s, double substep_s) {
        tool_.velocity_mm_per_s = velocity_mm_per_s;
        tool_.position_mm += substep_s * velocity_mm_per_s;
    }

    const ScenePlan& plan_;
    ToolMotion tool_;
    glm::dvec3 burr_mm_;
    glm::dvec3 force_n_;
};

class Cutting : public Truth {
  public:
    explicit Cutting(const ScenePlan& plan)
        : Truth(plan), bone_(plan.burr, plan.relative_stiffness, plan.burr_at_release_mm) {}
    void every_tick() override { bone_.refresh(); }

  protected:
    void move_burr(const glm::dvec3& velocity_mm_per_s, double substep_s) {
        bone_.advance(substep_s * velocity_mm_per_s);
        burr_mm_ = bone_.burr_mm();
    }
    SweptBone bone_;
};

class RigidCutting final : public Cutting {
  public:
    using Cutting::Cutting;

    void substep(double time_s, double substep_s) override {
        const OpenStep step = open(time_s, substep_s);
        const glm::dvec3 velocity = bone_.solve(step.inertia_n_s_per_mm, step.drive_n, substep_s);
        force_n_ = step.inertia_n_s_per_mm * velocity - step.drive_n;
        move_burr(velocity, substep_s);
        move_tool(velocity, substep_s);
    }
};

/// With e = x - p, k = K h + B: the mount pulls the burr with f = K e + k (v - w), the tool moves by
/// M v = drive - f. Without v that is f = a - b w, and the burr balances a - b w + F(w) = 0.
class CompliantCutting final : public Cutting {
  public:
    using Cutting::Cutting;

    void substep(double time_s, double substep_s) override {
        const OpenStep step = open(time_s, substep_s);
        const glm::dvec3 inertia = step.inertia_n_s_per_mm;
        const Mount& mount = plan_.mount;
        const double mount_k = mount.stiffness_n_per_mm * substep_s + mount.damping_n_s_per_mm;
        const glm::dvec3 share = 1.0 / (1.0 + mount_k / inertia);
        const glm::dvec3 a = share * (mount.stiffness_n_per_mm * (tool_.position_mm - burr_mm_) +
                                      mount_k / inertia * step.drive_n);
        const glm::dvec3 b = share * mount_k;
        const glm::dvec3 burr_velocity = bone_.solve(b, a, substep_s);
        force_n_ = b * burr_velocity - a;
        move_burr(burr_velocity, substep_s);
        move_tool((step.drive_n + force_n_) / inertia, substep_s);
    }
};

/// Heights are those of the burr's lowest point; q of what touches the plane, behind spring and damper.
class Wall final : public Truth {
  public:
    explicit Wall(const ScenePlan& plan) : Truth(plan) {}

    void substep(double time_s, double substep_s) override {
        const OpenStep step = open(time_s, substep_s);
        const double k = plan_.wall_n_per_mm;
        const double b = plan_.mount.damping_n_s_per_mm;
        const double radius_mm = plan_.burr.radius_mm();
        const double height_mm = tool_.position_mm.z - radius_mm;

        // Off the plane nothing pushes: K (q' - x') + B ((q' - q) / h - v) = 0.
        double velocity = step.drive_n.z / step.inertia_n_s_per_mm.z;
        double touching_mm =
            (k * (height_mm + substep_s * velocity) + b * (touching_mm_ / substep_s + velocity)) /
            (k + b / substep_s);
        double force_n = 0.0;
        if (touching_mm < 0.0) {
            // On it: f = K (q' - x') + B ((q' - q) / h - v) with q' = 0, M v = drive + f.
            touching_mm = 0.0;
            velocity = (step.drive_n.z - k * height_mm - b * touching_mm_ / substep_s) /
                       (step.inertia_n_s_per_mm.z + k * substep_s + b);
            force_n = step.inertia_n_s_per_mm.z * velocity - step.drive_n.z;
        }
        touching_mm_ = touching_mm;
        force_n_ = {0.0, 0.0, force_n};
        move_tool((step.drive_n + force_n_) / step.inertia_n_s_per_mm, substep_s);
        burr_mm_ = tool_.position_mm;
        burr_mm_.z = radius_mm + touching_mm_;
    }

  private:
    double touching_mm_ = 0.0;
};

std::vector<TruthTick> run(Truth&& truth, std::size_t ticks, int substeps_per_tick) {
    std::vector<TruthTick> record;
    record.reserve(ticks);
    const double substep_s = tick_s / substeps_per_tick;
    for (std::size_t tick = 0; tick < ticks; ++tick) {
        truth.every_tick();
        record.push_back(truth.now());
        for (int i = 0; i < substeps_per_tick; ++i)
            truth.substep(tick_s * static_cast<double>(tick) + i * substep_s, substep_s);
    }
    return record;
}

}  // namespace

std::vector<TruthTick> truth_of(const ScenePlan& plan, int substeps_per_tick) {
    const std::size_t ticks = plan.timing.released();
    if (plan.scene == MapScene::wall) return run(Wall(plan), ticks, substeps_per_tick);
    if (plan.mount.is_rigid()) return run(RigidCutting(plan), ticks, substeps_per_tick);
    return run(CompliantCutting(plan), ticks, substeps_per_tick);
}

}  // namespace osteomill::study
