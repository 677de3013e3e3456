#include "studies/stability/lifted_system.h"

#include <Eigen/Eigenvalues>

#include "studies/stability/exact_motion.h"

namespace osteomill::study {
namespace {

/// Far above what rounding does to an eigenvalue of 1, far below the decay of anything that settles within an
/// hour.
constexpr double rounding = 1e-10;
constexpr Eigen::Index moving = 2;  ///< x and v; the samples follow

/// Position that the model sampled `age` periods ago, as a row over the state; the newest is x itself.
Eigen::RowVectorXd sample(Eigen::Index age, Eigen::Index size) {
    return Eigen::RowVectorXd::Unit(size, age == 0 ? 0 : moving + age - 1);
}

}  // namespace

Eigen::MatrixXd lifted_system(const HeldBody& body, const ModelForce& model, const LinearHold& hold,
                              double tick_s) {
    const ExactMotion tick = exact_motion(body, tick_s);
    const double period_s = tick_s * static_cast<double>(hold.ticks_per_sample());
    const auto forces = static_cast<Eigen::Index>(hold.forces_remembered());
    const Eigen::Index size = moving + forces;

    Eigen::MatrixXd resistance(forces, size);  // by age, over the state
    for (Eigen::Index age = 0; age < forces; ++age) {
        const Eigen::RowVectorXd here = sample(age, size);
        const Eigen::RowVectorXd before = sample(age + 1, size);
        resistance.row(age) =
            model.stiffness_n_per_m * here + model.damping_n_s_per_m / period_s * (here - before);
    }

    Eigen::MatrixXd motion = Eigen::MatrixXd::Identity(moving, size);
    for (const std::vector<double>& weights : hold.weights) {
        const Eigen::RowVectorXd force =
            -Eigen::Map<const Eigen::RowVectorXd>(weights.data(), forces) * resistance;
        motion = (tick.of_state * motion + tick.of_force * force).eval();
    }

    Eigen::MatrixXd step(size, size);
    step.topRows(moving) = motion;
    for (Eigen::Index age = 0; age < forces; ++age) step.row(moving + age) = sample(age, size);
    return step;
}

double spectral_radius(const Eigen::MatrixXd& step) {
    return Eigen::EigenSolver<Eigen::MatrixXd>(step, false).eigenvalues().cwiseAbs().maxCoeff();
}

bool is_stable(const HeldBody& body, const ModelForce& model, const LinearHold& hold, double tick_s) {
    return spectral_radius(lifted_system(body, model, hold, tick_s)) < 1.0 - rounding;
}

}  // namespace osteomill::study
