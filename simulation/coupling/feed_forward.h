// The force of bone's change, which a spring passes too late: what a burr that is rigidly the hand would feel
// beyond the spring's force, for as long as the spring takes to catch up.
//
//     b = min(B, 150 N s/m),  s' = (b - s) / 80 ms
//     f' = d(e)/dt v - f / tau,  tau = min(60 ms, B / K)
//     0 <= f <= max(0, B v - |u|)
//
// with B the resistance of the bone to the burr along the hand's way, s its slow part, e what of b - s is
// beyond a quarter of s (differentiated at that s), v the hand's speed, K the spring and u its force along
// the way.
//
// A spring K before a resistance B is a low pass of B / K, and f is what it leaves of a step of B: both
// together are B v at once. In bone that resists evenly f is zero, however the hand moves, so it takes
// nothing from the range in which the spring is stable. It is open loop, as event transients are
// (Kuchenbecker, Fiene and Niemeyer 2006), and bounded: it only resists; with the spring it tends to no more
// than the rigid burr's force; its step in a tick is at most 0.1 N, with the spring's 0.15 N, or what the
// spring alone makes. A step that is cut short comes in the ticks after, while there is cause. Where bone
// ends, the spring relaxes by itself: an f below 0 was tried, and the force was farther from the model's.
//
// Three axes: f acts along the way of the hand, and B is the part against that way of the bone's force on a
// burr that goes there with 1 mm/s. Sideways nothing is fed forward: the edges' pull across the way is up to
// six times as strong and does work on a hand that it turns aside. So where a burr enters the side of a
// block, and that pull is most of the force, f is next to nothing. The way is the hand's velocity over 30 ms,
// v the part along it of the velocity over 5 ms. A way by the last 5 ms turned round with each swing of a
// hand on the spring; bone that was just cut then resisted nothing, and the next forward swing met it anew:
// a limit cycle in slots of 350 to 440 N s/m.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "simulation/device/haptic_device.h"

namespace osteomill {

class FeedForward {
  public:
    /// `arm`: on whose spring the burr is.
    explicit FeedForward(const PatientLimits& arm)
        : spring_n_per_mm_(arm.max_stiffness_n_per_mm),
          most_n_s_per_mm_(arm.scale.damping_n_s_per_mm(most_resistance_n_s_per_mm)) {}

    /// At rest at `hand_mm`, in air.
    void place(const glm::dvec3& hand_mm) noexcept {
        const FeedForward at_rest(spring_n_per_mm_, most_n_s_per_mm_, hand_mm);
        *this = at_rest;
    }

    /// Takes the hand's position after a tick of `tick_s` > 0, and returns the step along its way that a burr
    /// on it takes in such a tick; at least least_step_mm long once the hand has moved. Real-time safe.
    glm::dvec3 follow_hand(const glm::dvec3& hand_mm, double tick_s) noexcept {
        velocity_mm_per_s_ +=
            tick_s / (velocity_s + tick_s) * ((hand_mm - hand_mm_) / tick_s - velocity_mm_per_s_);
        smooth_mm_per_s_ += tick_s / (way_s + tick_s) * (velocity_mm_per_s_ - smooth_mm_per_s_);
        hand_mm_ = hand_mm;
        const double speed_mm_per_s = glm::length(smooth_mm_per_s_);
        if (speed_mm_per_s > at_rest_mm_per_s) {
            const glm::dvec3 before = way_;
            way_ = smooth_mm_per_s_ / speed_mm_per_s;
            wanted_n_ *= std::max(0.0, glm::dot(before, way_));
        }
        along_mm_per_s_ = std::max(0.0, glm::dot(velocity_mm_per_s_, way_));
        return std::max(least_step_mm, along_mm_per_s_ * tick_s) * way_;
    }

    /// Takes the resistance (B, 0 or more) along that way and the spring's force on the hand after the same
    /// tick; returns the force on the hand that is to be added. Real-time safe.
    const glm::dvec3& tick(double resistance_n_s_per_mm, const glm::dvec3& spring_n, double tick_s) noexcept {
        const double now_n_s_per_mm = std::min(resistance_n_s_per_mm, most_n_s_per_mm_);
        slow_n_s_per_mm_ += tick_s / (slow_s + tick_s) * (now_n_s_per_mm - slow_n_s_per_mm_);
        const double change_n_s_per_mm = beyond_slow(now_n_s_per_mm) - beyond_slow(last_n_s_per_mm_);
        last_n_s_per_mm_ = now_n_s_per_mm;

        const double lasts_s = std::min(longest_s, resistance_n_s_per_mm / spring_n_per_mm_);
        const double rigid_n = resistance_n_s_per_mm * along_mm_per_s_;
        const double left_n = rigid_n - std::abs(glm::dot(spring_n, way_));
        wanted_n_ =
            std::clamp((wanted_n_ + change_n_s_per_mm * along_mm_per_s_) * lasts_s / (lasts_s + tick_s), 0.0,
                       std::max(0.0, left_n));
        force_n_ += within_jump(-wanted_n_ * way_ - force_n_, spring_n - spring_n_);
        spring_n_ = spring_n;
        return force_n_;
    }

    // At the arm.
    static constexpr double most_resistance_n_s_per_mm = 0.15;
    static constexpr double most_step_n = 0.1;
    static constexpr double most_step_with_spring_n = 0.15;
    static constexpr double slow_s = 0.08;
    static constexpr double dead_share = 0.25;
    static constexpr double longest_s = 0.06;
    static constexpr double velocity_s = 0.005;
    static constexpr double way_s = 0.03;
    /// Slower, the way is the last one.
    static constexpr double at_rest_mm_per_s = 0.1;
    static constexpr double least_step_mm = 1e-4;

  private:
    FeedForward(double spring_n_per_mm, double most_n_s_per_mm, const glm::dvec3& hand_mm)
        : spring_n_per_mm_(spring_n_per_mm), most_n_s_per_mm_(most_n_s_per_mm), hand_mm_(hand_mm) {}

    /// The lattice's ripple stays within the dead zone.
    double beyond_slow(double resistance_n_s_per_mm) const noexcept {
        const double change = resistance_n_s_per_mm - slow_n_s_per_mm_;
        return std::copysign(std::max(0.0, std::abs(change) - dead_share * slow_n_s_per_mm_), change);
    }

    /// As much of a step of this force as its limits allow, beside the spring's.
    static glm::dvec3 within_jump(glm::dvec3 step_n, const glm::dvec3& of_spring_n) noexcept {
        if (const double length_n = glm::length(step_n); length_n > most_step_n)
            step_n *= most_step_n / length_n;
        // |of_spring_n + share step_n| = most_n
        const double most_n = std::max(most_step_with_spring_n, glm::length(of_spring_n));
        const double a = glm::dot(step_n, step_n);
        if (a == 0.0) return step_n;
        const double b = glm::dot(step_n, of_spring_n);
        const double c = glm::dot(of_spring_n, of_spring_n) - most_n * most_n;
        const double share = (std::sqrt(std::max(0.0, b * b - a * c)) - b) / a;
        return std::clamp(share, 0.0, 1.0) * step_n;
    }

    double spring_n_per_mm_;
    double most_n_s_per_mm_;
    glm::dvec3 hand_mm_{0.0};
    glm::dvec3 velocity_mm_per_s_{0.0};
    glm::dvec3 smooth_mm_per_s_{0.0};
    glm::dvec3 way_{0.0};  // unit; 0 before the hand has moved
    double along_mm_per_s_ = 0.0;
    double slow_n_s_per_mm_ = 0.0;
    double last_n_s_per_mm_ = 0.0;
    double wanted_n_ = 0.0;     // against the way: f, which force_n_ follows within its steps
    glm::dvec3 spring_n_{0.0};  // in the last tick, as force_n_
    glm::dvec3 force_n_{0.0};
};

}  // namespace osteomill
