// Reader of one tracked tool from an OpenIGTLink stream: its TRANSFORM messages and the STRING messages of a
// pedal, out of the bytes as they come. Headers, byte order and CRC are libopenigtlink's (openigtlink.org,
// protocol versions 1 to 3: of the later ones the extended header and the metadata are passed over). Messages
// of other types and names are skipped without being kept, whatever they hold.
//
// TRANSFORM: a rotation in float32, column by column, then the position in mm. A marker that is hidden is no
// sample: some servers then send the identity, to the bit (where no marker is), newer ones say so
// in metadata ("TransformStatus" that is not "OK"). STRING: text; the pedal is down where it is "1", "on",
// "true" or "down" in either case.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

/// Where the marker was, in the tracker's space.
struct TrackerSample {
    double stamp_s = 0.0;  ///< the sender's clock; 0: it says none
    glm::dvec3 position_mm{0.0};
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};  ///< marker axes to tracker axes
};

class TransformStream {
  public:
    /// A volume of 512^3 voxels of 16 bits, as an imager may send between the samples, and room.
    static constexpr std::uint64_t longest_skipped_bytes = std::uint64_t{1} << 30;
    /// Of a message that is read: a matrix or a word, with metadata.
    static constexpr std::uint64_t longest_read_bytes = 4096;
    /// Characters of a name.
    static constexpr std::size_t longest_name = 20;
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

    /// The next bytes, cut anywhere. False, and nothing more is read: this is no OpenIGTLink, or a message is
    /// longer than any may be.
    bool feed(std::span<const std::uint8_t> bytes);
    /// The stream begins anew; name and counts stay.
    void restart();

    const std::string& name() const { return name_; }
    const Counts& counts() const { return counts_; }

  private:
    enum class Kind { other, transform, pedal };

    bool begin_message();
    void end_message();
    void take_transform(std::span<const std::uint8_t> content, bool is_seen);
    void take_string(std::span<const std::uint8_t> content);

    std::string name_;
    std::string pedal_;
    Sinks sinks_;
    Counts counts_;
    std::vector<std::uint8_t> message_;  // header, then the body of one that is read
    std::uint64_t body_left_ = 0;        // yet to come
    bool has_header_ = false;
    Kind kind_ = Kind::other;
    std::uint16_t version_ = 0;
    std::uint64_t stamp_ = 0;
    std::uint64_t crc_ = 0;
};

}  // namespace osteomill
