// Splitter of an OpenIGTLink stream of bytes into messages. Headers, byte order and CRC are libopenigtlink's
// (openigtlink.org, protocol versions 1 to 3; the later ones' extended header and metadata are separated).
// Other messages are skipped without being kept, whatever their size.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

/// A message whose CRC is right; the spans live for the call.
struct IgtlMessageView {
    std::string type;
    std::string name;         ///< the device's name
    std::uint64_t stamp = 0;  ///< 32 bits of seconds, 32 of their fraction; 0: it says none
    std::span<const std::uint8_t> content{};
    std::span<const std::uint8_t> metadata_header{};
    std::span<const std::uint8_t> metadata{};
};

/// Big endian, as all of OpenIGTLink.
std::uint64_t number_at(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t width);

/// The text of a STRING message; nothing if its sizes contradict each other.
std::optional<std::string> text_of_string_message(std::span<const std::uint8_t> content);

class IgtlStream {
  public:
    /// A volume of 512^3 voxels of 16 bits, as an imager may send between wanted messages, and a margin.
    static constexpr std::uint64_t longest_skipped_bytes = std::uint64_t{1} << 30;
    /// The longest message that is read: a matrix or a line of text, with metadata.
    static constexpr std::uint64_t longest_read_bytes = 4096;
    /// Characters of a name.
    static constexpr std::size_t longest_name = 20;

    struct Sinks {
        std::function<bool(const std::string& type, const std::string& name)> wants;
        std::function<void(const IgtlMessageView&)> take;
        /// A message that is wanted has a wrong CRC or sizes that contradict each other, or is too long.
        std::function<void()> damaged;
    };

    explicit IgtlStream(Sinks sinks);

    /// The next bytes, cut anywhere. False, and nothing more is to be read: this is no OpenIGTLink, or a
    /// message is longer than any may be.
    bool feed(std::span<const std::uint8_t> bytes);
    /// The stream begins anew.
    void restart();

  private:
    bool begin_message();
    void end_message();

    Sinks sinks_;
    std::vector<std::uint8_t> message_{};  // header, then the body of one that is wanted
    std::uint64_t body_left_ = 0;          // yet to come
    bool has_header_ = false;
    bool is_wanted_ = false;
    IgtlMessageView head_{};
    std::uint16_t version_ = 0;
    std::uint64_t crc_ = 0;
};

}  // namespace osteomill
