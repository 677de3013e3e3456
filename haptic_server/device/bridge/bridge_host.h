// The server's side of the bridge to an arm in a process of its own: datagrams in, datagrams out, with the
// time handed in. It opens no socket and knows no thread. What is said: docs/device-bridge.md; the bytes:
// bridge/osteomill_bridge.h, which the arm's side shares.
//
//   hello -> welcome with a session that nobody can guess -> the first pose of that session: this is the arm
//
// A hello alone changes nothing, so one that was recorded and is sent again does no harm.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bridge/osteomill_bridge.h"

namespace osteomill {

using BridgeMessage = std::array<std::uint8_t, OMB_MESSAGE_BYTES>;

/// Who sent a datagram, as the system names them; compared, never read.
using PeerAddress = std::vector<std::uint8_t>;

/// What to tell the arm now.
struct BridgeForce {
    glm::dvec3 force_n{0.0};      ///< on the hand, device space
    glm::dvec3 torque_n_mm{0.0};  ///< on the hand, about what the arm's poses place
    bool is_off = true;           ///< nothing is rendered now
};

/// Messages that did nothing, and why.
struct BridgeCounts {
    std::uint64_t poses = 0;         ///< taken
    std::uint64_t lost = 0;          ///< numbers that never came
    std::uint64_t out_of_order = 0;  ///< came twice, or after a newer one
    std::uint64_t refused = 0;       ///< of another key, session, version or size
    std::uint64_t late = 0;          ///< poses that had been under way for too long
    std::uint64_t impossible = 0;    ///< numbers that no arm can mean
    std::uint64_t other_arms = 0;    ///< hellos of another arm while one is served
};

class BridgeHost {
  public:
    /// An arm that has said nothing for so long may be followed by another.
    static constexpr std::uint64_t gone_ns = 250'000'000;
    /// A pose that answers a force from longer ago is too old to act on, and so is what would answer it.
    static constexpr std::uint64_t latest_round_trip_ns = 50'000'000;
    /// Round trips that the delay is taken from.
    static constexpr std::size_t round_trips_kept = 256;

    /// `random` gives numbers that nobody can guess.
    BridgeHost(const omb_key& key, std::function<std::uint64_t()> random);

    /// What to send back to `from` at once; nullopt: nothing. Takes what is no message, too. Does not throw
    /// but for memory.
    std::optional<BridgeMessage> take(std::span<const std::uint8_t> datagram, const PeerAddress& from,
                                      std::uint64_t now_ns);

    /// Whether the arm's newest pose has not been answered.
    bool awaits_answer() const { return awaits_answer_; }
    /// Answers it: to be sent to peer().
    BridgeMessage answer(std::uint64_t now_ns, const BridgeForce& wanted);
    /// The arm that is served.
    const PeerAddress& peer() const { return peer_; }

    /// Whether the last take() was of a pose to act on.
    bool has_fresh_pose() const { return has_fresh_pose_; }
    /// The newest to act on.
    const omb_pose& pose() const { return pose_; }
    /// The arm that is served; nullopt before the first.
    const std::optional<omb_arm>& arm() const { return arm_; }
    const BridgeCounts& counts() const { return counts_; }
    /// The arm has said goodbye, or nothing for long.
    bool is_gone(std::uint64_t now_ns) const { return session_ == 0 || now_ns - heard_ns_ > gone_ns; }

    /// What half of the last messages took to the arm and back; nullopt before there are enough.
    std::optional<double> round_trip_median_s() const;

    /// Why the arm's hello was refused last, a text that lives for ever; empty where none was.
    const char* refusal() const { return refusal_; }

  private:
    struct Candidate {
        PeerAddress from{};
        std::uint64_t nonce = 0;
        std::uint64_t session = 0;
        omb_arm arm{};
    };

    BridgeMessage begun(omb_kind kind, std::uint64_t session, std::uint64_t now_ns);
    std::optional<BridgeMessage> take_hello(const std::uint8_t* message, const PeerAddress& from,
                                            std::uint64_t now_ns);
    void take_pose(const omb_header& header, const std::uint8_t* message, std::uint64_t now_ns);
    void measure(std::uint64_t round_trip_ns);

    omb_key key_;
    std::function<std::uint64_t()> random_;
    Candidate candidate_;
    PeerAddress peer_;
    std::uint64_t session_ = 0;
    std::optional<omb_arm> arm_;
    std::uint64_t said_ = 0;   // messages of ours
    std::uint64_t heard_ = 0;  // the newest sequence of the arm's
    std::uint64_t heard_ns_ = 0;
    omb_pose pose_{};
    bool has_fresh_pose_ = false;
    bool awaits_answer_ = false;
    bool is_late_ = false;              // the pose that awaits an answer
    std::uint64_t asked_clock_ns_ = 0;  // as it stood in it
    BridgeCounts counts_;
    std::vector<std::uint64_t> round_trips_ns_;
    std::size_t next_round_trip_ = 0;
    const char* refusal_ = "";
};

/// Why no arm can be so: a text that lives for ever; nullptr for one that can be.
const char* why_impossible(const omb_arm& arm);

/// Whether all its numbers are finite and the quaternion, where there is one, is a rotation.
bool is_possible(const omb_pose& pose);

}  // namespace osteomill
