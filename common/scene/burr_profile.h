// The outline of a burr's head: half of its section through the spindle, in the burr's own axes.
//
// Every head but the ball is the body of revolution of a convex chain of straight lines, rounded: all points
// within `rounding` of the chain's inside. The sides of a barrel and the half ball of a pear are chords of 8
// and 7.5 degrees' turn, at most 0.3 % of the radius off. Real edges are rounded, too; here by a tenth of the
// diameter. The tip lies half a diameter below the origin, as a ball's does.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "common/scene/burr.h"

namespace osteomill {

/// A burr's surface where it is nearest to a point, in the profile's unit of length.
struct NearestSurface {
    double distance = 0.0;  ///< from the surface, negative inside
    double out = 0.0;       ///< the outward normal: away from the spindle
    double up = 0.0;        ///< and along it, from tip to shank
};

/// A point of the outline.
struct OutlinePoint {
    double radius = 0.0;  ///< from the spindle
    double height = 0.0;  ///< above the origin, along the spindle
    double out = 0.0;     ///< the outward normal, as of NearestSurface
    double up = 0.0;
};

class BurrProfile {
  public:
    /// In mm times `scale`. Throws std::invalid_argument as require_valid(BurrHead). Allocates.
    BurrProfile(const BurrHead& head, double diameter_mm, double scale = 1.0);

    /// At a distance `radius` >= 0 from the spindle and a height above the origin. Real-time safe, as are all
    /// functions below.
    NearestSurface nearest(double radius, double height) const noexcept;

    double tip_height() const { return chain_.front().height - rounding_; }
    double top_height() const { return chain_.back().height + rounding_; }
    double largest_radius() const { return largest_radius_; }
    /// Radius of the edges: a ball of it that touches the outline from within, anywhere, lies in the head.
    double rounding() const { return rounding_; }
    /// Radius of a ball about the point half-way up the spindle that holds all of the head.
    double bounding_radius() const;

    /// Reach of the head from the origin along a direction in burr axes (unit).
    double reach_along(const glm::dvec3& direction) const noexcept;

    /// Length of the outline from the tip, on the spindle, to the other end, on the spindle.
    double outline_length() const { return outline_length_; }
    /// The point `along` from the tip, 0 to outline_length().
    OutlinePoint outline_at(double along) const noexcept;

  private:
    struct Corner {
        double radius;
        double height;
    };
    /// From a corner to the next.
    struct Side {
        Corner from;
        double length;
        double along_out, along_up;  ///< unit
        double out, up;              ///< outward normal, unit
    };
    /// A stretch of the outline: an arc about a corner, or a side.
    struct Stretch {
        double from;  ///< along the outline
        double length;
        std::size_t index;  ///< of the side, or of the corner
        bool is_arc;
        double first_angle;  ///< of an arc's normal from straight down, towards straight out
    };

    void build_outline();

    double rounding_;
    double largest_radius_;
    std::vector<Corner> chain_;  // from the tip up; the ends are joined to the spindle
    std::vector<Side> sides_;
    std::vector<Stretch> outline_;
    double outline_length_ = 0.0;
};

}  // namespace osteomill
