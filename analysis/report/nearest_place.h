// The nearest of many places (Boost.Geometry's R-tree).
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>

namespace osteomill {

class NearestPlace {
  public:
    explicit NearestPlace(std::span<const glm::dvec3> places_mm);
    ~NearestPlace();
    NearestPlace(NearestPlace&&) noexcept;
    NearestPlace& operator=(NearestPlace&&) noexcept;

    /// Nothing if there is no place.
    std::optional<glm::dvec3> nearest_mm(const glm::dvec3& from_mm) const;
    std::optional<double> distance_mm(const glm::dvec3& from_mm) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace osteomill
