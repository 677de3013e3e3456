#include "analysis/report/nearest_place.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <vector>

namespace osteomill {

namespace {

namespace geometry = boost::geometry;
using Point = geometry::model::point<double, 3, geometry::cs::cartesian>;

Point point(const glm::dvec3& place) {
    return {place.x, place.y, place.z};
}

std::vector<Point> points(std::span<const glm::dvec3> places) {
    std::vector<Point> all;
    all.reserve(places.size());
    for (const glm::dvec3& place : places) all.push_back(point(place));
    return all;
}

}  // namespace

struct NearestPlace::Tree {
    geometry::index::rtree<Point, geometry::index::linear<16>> points;
};

NearestPlace::NearestPlace(std::span<const glm::dvec3> places_mm)
    : tree_(std::make_unique<Tree>(Tree{decltype(Tree::points)(points(places_mm))})) {}
NearestPlace::~NearestPlace() = default;
NearestPlace::NearestPlace(NearestPlace&&) noexcept = default;
NearestPlace& NearestPlace::operator=(NearestPlace&&) noexcept = default;

std::optional<glm::dvec3> NearestPlace::nearest_mm(const glm::dvec3& from_mm) const {
    const auto found = tree_->points.qbegin(geometry::index::nearest(point(from_mm), 1));
    if (found == tree_->points.qend()) return std::nullopt;
    return glm::dvec3(found->get<0>(), found->get<1>(), found->get<2>());
}

std::optional<double> NearestPlace::distance_mm(const glm::dvec3& from_mm) const {
    const auto nearest = nearest_mm(from_mm);
    return nearest ? std::optional(geometry::distance(point(from_mm), point(*nearest))) : std::nullopt;
}

}  // namespace osteomill
