// A virtual fixture: help by force for the hand that guides the burr. Plain data, patient LPS; its force is
// that of simulation/fixtures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <variant>

namespace osteomill {

using FixtureSet = std::uint32_t;

// Some of a scene's fixtures, as a number: bit i is the i-th.

inline constexpr std::size_t most_fixtures = 16;  ///< of a scene
inline constexpr FixtureSet every_fixture = (FixtureSet{1} << most_fixtures) - 1;

constexpr FixtureSet fixture_bit(std::size_t number) {
    return FixtureSet{1} << number;
}
constexpr bool has_fixture(FixtureSet set, std::size_t number) {
    return (set & fixture_bit(number)) != 0;
}

/// `guide` draws the burr's centre to a line, a tube or a plane. `forbidden` keeps the burr's head off a
/// structure. `slow` makes its feed heavy, or its spindle slow, near a structure.
enum class FixtureKind { guide, forbidden, slow };
inline constexpr std::array fixture_kind_names{"guide", "forbidden", "slow"};

/// A straight line between two places.
struct LineGuide {
    glm::dvec3 from_mm{0.0};
    glm::dvec3 to_mm{0.0, 0.0, 1.0};

    bool operator==(const LineGuide&) const = default;
};

/// Without an end; `normal` is of unit length.
struct PlaneGuide {
    glm::dvec3 at_mm{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};

    bool operator==(const PlaneGuide&) const = default;
};

/// Which of its numbers count is its kind's matter.
struct Fixture {
    std::string name{};
    FixtureKind kind = FixtureKind::guide;
    bool is_on = true;
    std::variant<LineGuide, PlaneGuide> path{};  ///< guide
    double radius_mm = 0.0;                      ///< guide: nothing is felt within this of its path
    double reach_mm = 5.0;                       ///< guide: nor farther than this beyond that
    std::string tissue{};                        ///< forbidden, slow: a protected one
    double distance_mm = 1.0;                    ///< forbidden, slow: it begins so far from the tissue
    double fade_mm = 2.0;                        ///< over which it comes in
    double stiffness_n_per_mm = 1.0;             ///< guide, forbidden
    double damping_n_s_per_m = 5.0;              ///< of the burr's motion
    double max_force_n = 1.5;                    ///< guide, forbidden: its spring pushes no harder
    double spindle_share = 1.0;                  ///< slow: of the spindle's speed, once it has come in

    bool operator==(const Fixture&) const = default;
};

/// The defaults of a fixture: values that the file does not give.
inline Fixture usual_fixture(FixtureKind kind) {
    Fixture usual{.kind = kind};
    if (kind == FixtureKind::forbidden) {
        usual.fade_mm = 0.5;
        usual.max_force_n = 3.0;
    }
    if (kind == FixtureKind::slow) {
        usual.distance_mm = 2.0;
        usual.fade_mm = 1.0;
        usual.damping_n_s_per_m = 50.0;
    }
    return usual;
}

/// Bound on what a file or a recording may hold, as most_fixtures.
inline constexpr std::size_t longest_fixture_name = 100;  ///< bytes

/// The set of those that are on. `fixtures`: at most most_fixtures.
inline FixtureSet fixtures_on(std::span<const Fixture> fixtures) {
    FixtureSet on = 0;
    for (std::size_t i = 0; i < fixtures.size(); ++i)
        if (fixtures[i].is_on) on |= fixture_bit(i);
    return on;
}

}  // namespace osteomill
