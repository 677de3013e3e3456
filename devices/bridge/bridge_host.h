// The server's side of the bridge to an arm in another process: datagrams in, datagrams out, with the time
// passed in. It opens no socket and has no thread. The protocol: docs/device-bridge.md; the bytes:
// bridge/osteomill_bridge.h, which the arm's side shares.
//
//   hello -> welcome with a session that nobody can guess -> the first pose of that session: this is the arm
//
// The sender of a hello is not remembered: the session is a cookie, made of the sender's address, of the
// welcome's number and time, which the first pose repeats, and of a secret. So recorded or forged hellos, in
// any number, take no place. A welcome is valid once, and soon expires.
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

/// The force to send to the arm now.
struct BridgeForce {
    glm::dvec3 force_n{0.0};      ///< on the hand, device space
    glm::dvec3 torque_n_mm{0.0};  ///< on the hand, about the point of the arm's poses
    bool is_off = true;           ///< nothing is rendered now
};

/// Messages that did nothing, and why.
struct BridgeCounts {
    std::uint64_t poses = 0;         ///< taken
    std::uint64_t lost = 0;          ///< numbers that never came
    std::uint64_t out_of_order = 0;  ///< came twice, or after a newer one
    std::uint64_t refused = 0;       ///< wrong key, session, version or size
    std::uint64_t late = 0;          ///< poses that had been under way for too long
    std::uint64_t impossible = 0;    ///< numbers that no arm can mean
    std::uint64_t other_arms = 0;    ///< hellos of another arm while one is served
};

class BridgeHost {
  public:
    /// Silence of the arm after which another may follow it; a welcome unanswered for so long is stale.
    static constexpr std::uint64_t gone_ns = 250'000'000;
    /// Poses that follow another session's sooner than this are not acted on: the loop must notice the loss
    /// of the first arm before the second, or the tool would jump from one to the other with the spindle on.
    static constexpr std::uint64_t between_arms_ns = 50'000'000;
    /// A pose that answers an older force is too old to act on, and so is the answer to it.
    static constexpr std::uint64_t latest_round_trip_ns = 50'000'000;
    /// An arm states how long it kept a force before it sent its pose. No more than this is believed, since
    /// its clock may run at any rate: so a pose is older than it seems by at most this much.
    static constexpr std::uint64_t longest_kept_ns = 50'000'000;
    /// Round trips that the delay is taken from.
    static constexpr std::size_t round_trips_kept = 256;

    /// `random` gives numbers that nobody can guess.
    BridgeHost(const omb_key& key, const std::function<std::uint64_t()>& random);

    /// Reads a datagram, which need not be a message, and returns the message to send back to `from` at once;
    /// nullopt: none. Throws only if memory is short.
    std::optional<BridgeMessage> take(std::span<const std::uint8_t> datagram, const PeerAddress& from,
                                      std::uint64_t now_ns);

    /// Whether the arm's newest pose has not been answered.
    bool awaits_answer() const { return awaits_answer_; }
    /// Answers it: to be sent to peer().
    BridgeMessage answer(std::uint64_t now_ns, const BridgeForce& wanted);
    /// The arm that is served.
    const PeerAddress& peer() const { return peer_; }

    /// From now on only the served arm may join again: force and coupling depend on it.
    void keep_arm() { is_arm_kept_ = true; }

    /// Whether the last take() was of a pose to act on.
    bool has_fresh_pose() const { return has_fresh_pose_; }
    /// The newest pose to act on.
    const omb_pose& pose() const { return pose_; }
    /// The pose's date by our own clock, which it echoes: it was sent no earlier, however long it lay in a
    /// queue.
    std::uint64_t said_ns() const { return said_ns_; }
    /// Changes when another arm joins, or the same arm anew.
    std::uint64_t session() const { return session_; }
    /// The arm that is served, or was; nullopt before the first.
    const std::optional<omb_arm>& arm() const { return arm_; }
    const BridgeCounts& counts() const { return counts_; }
    /// The arm has said goodbye, or has been silent for long.
    bool is_gone(std::uint64_t now_ns) const { return session_ == 0 || now_ns - heard_ns_ > gone_ns; }

    /// The median time of the last messages to the arm and back; nullopt before there are enough.
    std::optional<double> round_trip_median_s() const;

    /// The reason of the last refusal of the arm's hello, a text with static lifetime; empty without one.
    const char* refusal() const { return refusal_; }

  private:
    using Digest = std::array<std::uint8_t, 32>;
    /// Statements of arms about themselves, until one of them joins. A holder of the key can have made only a
    /// few that differ; without it, so many forged arms would be needed to push one out.
    static constexpr std::size_t statements_kept = 1024;
    struct Statement {
        omb_arm arm{};
        Digest digest{};
    };

    BridgeMessage begun(omb_kind kind, std::uint64_t session, std::uint64_t now_ns);
    std::optional<BridgeMessage> take_hello(const std::uint8_t* message, const PeerAddress& from,
                                            std::uint64_t now_ns);
    /// The session of the arm that this welcome greets. Its last digits are the number of the statement.
    std::uint64_t cookie(std::uint64_t welcome_sequence, std::uint64_t welcome_clock_ns,
                         const PeerAddress& to, std::size_t statement) const;
    bool may_join(const PeerAddress& from, std::uint64_t now_ns) const {
        return is_gone(now_ns) || from == peer_;
    }
    bool is_another_arm(const omb_arm& arm) const;
    void try_to_join(const omb_header& header, const std::uint8_t* message, const PeerAddress& from,
                     std::uint64_t now_ns);
    void take_pose(const omb_header& header, const std::uint8_t* message, std::uint64_t now_ns);
    void measure(std::uint64_t round_trip_ns);

    omb_key key_;
    omb_key secret_{};  // the cookies' key
    std::vector<Statement> statements_{statements_kept};
    PeerAddress peer_;
    std::uint64_t session_ = 0;
    std::uint64_t welcome_ = 0;       // the number of the one that it began with
    std::uint64_t acts_from_ns_ = 0;  // no pose before does
    std::optional<omb_arm> arm_;
    bool is_arm_kept_ = false;
    std::uint64_t said_ = 0;   // messages of ours
    std::uint64_t heard_ = 0;  // the newest sequence of the arm's
    std::uint64_t heard_ns_ = 0;
    omb_pose pose_{};
    std::uint64_t said_ns_ = 0;
    bool has_fresh_pose_ = false;
    bool awaits_answer_ = false;
    bool is_answered_off_ = false;        // the pose that awaits an answer: it is not acted on
    std::uint64_t request_clock_ns_ = 0;  // as it stood in it
    BridgeCounts counts_;
    std::vector<std::uint64_t> round_trips_ns_;
    std::size_t next_round_trip_ = 0;
    const char* refusal_ = "";
};

/// The reason for which no arm can be like this, a text with static lifetime; nullptr for a possible one.
const char* why_impossible(const omb_arm& arm);

/// Whether all its numbers are finite and the quaternion, if there is one, is a rotation.
bool is_possible(const omb_pose& pose);

}  // namespace osteomill
