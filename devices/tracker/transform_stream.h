// Reader of one tracked tool from an OpenIGTLink stream: its TRANSFORM messages and the STRING messages of a
// pedal.
//
// TRANSFORM: a rotation in float32, column by column, then the position in mm. A marker that is hidden is no
// sample: some servers then send exactly the identity, a place where no marker is; newer ones report it in
// metadata ("TransformStatus" that is not "OK"). STRING: text; the pedal is down if it is "1", "on", "true"
// or "down" in either case.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "common/igtl/igtl_stream.h"

namespace osteomill {

/// A pose of the marker in the tracker's space.
struct TrackerSample {
    double stamp_s = 0.0;  ///< the sender's clock; 0: it says none
    glm::dvec3 position_mm{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< marker axes to tracker axes
};

class TransformStream {
  public:
    /// How far axes may be from unit length and right angles.
    static constexpr double rotation_tolerance = 1e-3;

    struct Sinks {
        std::function<void(const TrackerSample&)> sample;
        std::function<void(bool is_down)> pedal;
    };
    struct Counts {
        std::uint64_t samples = 0;
        std::uint64_t of_other_names = 0;  ///< TRANSFORMs
        std::uint64_t damaged = 0;         ///< wrong CRC, size or contents
        std::uint64_t hidden = 0;          ///< TRANSFORMs that say that the marker is not seen
    };

    /// `name`: whose TRANSFORMs; empty: the first that is seen. `pedal`: whose STRINGs; empty: nobody's.
    TransformStream(std::string name, std::string pedal, Sinks sinks);
    TransformStream(const TransformStream&) = delete;
    TransformStream& operator=(const TransformStream&) = delete;

    /// Does the same as IgtlStream::feed.
    bool feed(std::span<const std::uint8_t> bytes) { return stream_.feed(bytes); }
    /// The stream begins anew; name and counts stay.
    void restart() { stream_.restart(); }

    const std::string& name() const { return name_; }
    const Counts& counts() const { return counts_; }

  private:
    bool wants(const std::string& type, const std::string& name);
    void take(const IgtlMessageView& message);
    void take_transform(const IgtlMessageView& message);

    std::string name_;
    std::string pedal_;
    Sinks sinks_;
    Counts counts_{};
    IgtlStream stream_;
};

}  // namespace osteomill
