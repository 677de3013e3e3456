#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "imaging/phantoms/temporal_bone.h"

namespace osteomill::air_cells_test {
namespace {

class Places {
  public:
    explicit Places(unsigned seed) : random_(seed) {}
    glm::dvec3 next(double within_mm) {
        std::uniform_real_distribution<double> mm(-within_mm, within_mm);
        return {mm(random_), mm(random_), mm(random_)};
    }

  private:
    std::mt19937 random_;
};

double at(const glm::dvec3& p) {
    return air_cells_mm(p, air_cells_near(p, 1.0));
}

TEST(AirCells, AreTheSameFromEveryBlockThatHoldsAPlace) {
    Places places(7);
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 p = places.next(15.0);
        const double found = air_cells_mm(p, air_cells_near(p + places.next(0.5), 1.0));
        EXPECT_NEAR(found, air_cells_mm(p, air_cells_near(p, 4.0)), 1e-12);
    }
}

TEST(AirCells, AreADistanceWithoutSteps) {
    Places places(11);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 p = places.next(15.0), step = places.next(0.02);
        EXPECT_LE(std::abs(at(p + step) - at(p)), 1.5 * glm::length(step) + 1e-12);
    }
}

TEST(AirCells, AreMostlyAirWithinThinSepta) {
    Places places(13);
    int in_air = 0, in_bone = 0, open_ways = 0, closed_ways = 0;
    for (int i = 0; i < 4000; ++i) {
        const double mm = at(places.next(15.0));
        (mm < 0.0 ? in_air : in_bone) += 1;
        EXPECT_LT(mm, 0.5) << "septa are thin";
    }
    EXPECT_GT(in_air, in_bone);
    EXPECT_GT(in_bone, 400);
    // From middle to middle of cells that touch: through a septum of 0.32 mm, or through its opening.
    const auto cells = air_cells_near({0.0, 0.0, 0.0}, 8.0);
    for (const AirCell& one : cells)
        for (const AirCell& other : cells) {
            const glm::dvec3 across = other.middle_mm - one.middle_mm;
            const double apart_mm = glm::length(across);
            if (apart_mm == 0.0 || apart_mm > 3.2 || glm::length(one.middle_mm) > 5.0) continue;
            const glm::dvec3 half_way = one.middle_mm + 0.5 * across;
            const auto as_near = std::ranges::count_if(cells, [&](const AirCell& cell) {
                return glm::distance(cell.middle_mm, half_way) < 0.5 * apart_mm + 0.6;
            });
            if (as_near > 2) continue;  // they do not touch there
            const double most_mm = at(half_way);
            const bool is_closed = most_mm > 0.0;
            (is_closed ? closed_ways : open_ways) += 1;
            EXPECT_TRUE(!is_closed || most_mm >= 0.16 - 1e-9) << most_mm;
            EXPECT_LT(at(one.middle_mm), 0.0) << "the middle of a cell";
        }
    EXPECT_GT(open_ways, 0);
    EXPECT_GT(closed_ways, open_ways);
}

TEST(AirCells, AreNoneWithoutNeighbours) {
    EXPECT_EQ(air_cells_mm({0.0, 0.0, 0.0}, {}), 100.0);
}

}  // namespace
}  // namespace osteomill::air_cells_test
