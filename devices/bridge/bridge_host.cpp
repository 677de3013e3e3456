#include "devices/bridge/bridge_host.h"

#include <algorithm>
#include <cmath>

namespace osteomill {

namespace {

constexpr double strongest_arm_n = 200.0;
constexpr double heaviest_arm_kg = 20.0;
constexpr double farthest_mm = 1e5;

bool within(double value, double least, double most) {
    return std::isfinite(value) && value >= least && value <= most;
}

template <std::size_t count>
bool all_within(const double (&values)[count], double most) {
    return std::ranges::all_of(values, [&](double value) { return within(value, -most, most); });
}

bool is_same(const omb_arm& one, const omb_arm& other) {
    BridgeMessage first{};
    BridgeMessage second{};
    omb_put_hello(first.data(), 0, &one);
    omb_put_hello(second.data(), 0, &other);
    return first == second;
}

void store(const glm::dvec3& from, double (&to)[3]) {
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

}  // namespace

const char* why_impossible(const omb_arm& arm) {
    if (!within(arm.max_force_n, 0.01, strongest_arm_n)) return "max_force_n must be 0.01 to 200 N";
    if (!within(arm.max_torque_n_mm, 0.0, 1e5)) return "max_torque_n_mm must be 0 to 100000 N mm";
    if (!within(arm.max_stiffness_n_per_mm, 0.001, 1000.0))
        return "max_stiffness_n_per_mm must be 0.001 to 1000 N/mm";
    if (!within(arm.apparent_mass_kg, 0.001, heaviest_arm_kg))
        return "apparent_mass_kg must be 0.001 to 20 kg";
    if (!within(arm.position_step_mm, 0.0, 1.0)) return "position_step_mm must be 0 to 1 mm";
    if (!all_within(arm.tool_from_handle_mm, 1000.0)) return "tool_from_handle_mm must be within 1 m";
    for (int axis = 0; axis < 3; ++axis)
        if (!within(arm.workspace_min_mm[axis], -farthest_mm, farthest_mm) ||
            !within(arm.workspace_max_mm[axis], arm.workspace_min_mm[axis], farthest_mm))
            return "workspace_min_mm must be below workspace_max_mm, within 100 m";
    return nullptr;
}

bool is_possible(const omb_pose& pose) {
    if (!all_within(pose.position_mm, farthest_mm)) return false;
    if ((pose.status & OMB_HAS_VELOCITY) != 0 && !all_within(pose.velocity_mm_per_s, 1e6)) return false;
    if ((pose.status & OMB_HAS_ORIENTATION) == 0) return true;
    double squared = 0.0;
    for (const double part : pose.quaternion) squared += part * part;
    return std::isfinite(squared) && std::abs(squared - 1.0) < 0.01;
}

BridgeHost::BridgeHost(const omb_key& key, const std::function<std::uint64_t()>& random) : key_(key) {
    std::array<std::uint8_t, 32> secret{};
    for (std::size_t i = 0; i < secret.size(); i += 8) omb_put(&secret[i], random(), 8);
    omb_set_key(&secret_, secret.data(), secret.size());
    round_trips_ns_.reserve(round_trips_kept);
}

BridgeMessage BridgeHost::begun(omb_kind kind, std::uint64_t session, std::uint64_t now_ns) {
    BridgeMessage message;
    const omb_header header{static_cast<std::uint16_t>(kind), session, ++said_, now_ns};
    omb_put_header(message.data(), &header);
    return message;
}

std::optional<BridgeMessage> BridgeHost::take_hello(const std::uint8_t* message, const PeerAddress& from,
                                                    std::uint64_t now_ns) {
    omb_arm arm;
    const std::uint64_t nonce = omb_get_hello(message, &arm);
    if (const char* why = why_impossible(arm)) {
        refusal_ = why;
        ++counts_.impossible;
        return std::nullopt;
    }
    if (is_another_arm(arm))
        refusal_ = "another arm than the one at the start wants to join: start haptic_server anew for it";
    if (is_another_arm(arm) || !may_join(from, now_ns)) {
        ++counts_.other_arms;
        return std::nullopt;
    }
    BridgeMessage stated{};
    omb_put_hello(stated.data(), 0, &arm);
    Digest digest;
    omb_hmac(&secret_, stated.data(), stated.size(), digest.data());
    const std::size_t place = omb_get(digest.data(), 8) % statements_kept;
    statements_[place] = {arm, digest};
    BridgeMessage welcome = begun(OMB_WELCOME, cookie(said_ + 1, now_ns, from, place), now_ns);
    omb_put_welcome(welcome.data(), nonce);
    omb_seal(welcome.data(), &key_);
    return welcome;
}

std::uint64_t BridgeHost::cookie(std::uint64_t welcome_sequence, std::uint64_t welcome_clock_ns,
                                 const PeerAddress& to, std::size_t statement) const {
    std::vector<std::uint8_t> greeted(16);
    omb_put(greeted.data(), welcome_sequence, 8);
    omb_put(greeted.data() + 8, welcome_clock_ns, 8);
    const Digest& stated = statements_[statement].digest;
    greeted.insert(greeted.end(), stated.begin(), stated.end());
    greeted.insert(greeted.end(), to.begin(), to.end());
    Digest digest;
    omb_hmac(&secret_, greeted.data(), greeted.size(), digest.data());
    return omb_get(digest.data(), 8) / statements_kept * statements_kept + statement;
}

bool BridgeHost::is_another_arm(const omb_arm& arm) const {
    return is_arm_kept_ && !is_same(*arm_, arm);
}

void BridgeHost::try_to_join(const omb_header& header, const std::uint8_t* message, const PeerAddress& from,
                             std::uint64_t now_ns) {
    if (!may_join(from, now_ns)) return;
    omb_pose pose;
    omb_get_pose(message, &pose);
    // Somebody has joined already by this welcome or an earlier one; or the pose is stale.
    if (pose.echo_sequence <= welcome_ || now_ns - pose.echo_clock_ns > gone_ns) return;
    const std::size_t statement = header.session % statements_kept;
    const omb_arm& arm = statements_[statement].arm;
    if (header.session != cookie(pose.echo_sequence, pose.echo_clock_ns, from, statement) ||
        is_another_arm(arm))
        return;
    if (welcome_ != 0) acts_from_ns_ = heard_ns_ + between_arms_ns;
    session_ = header.session;
    welcome_ = pose.echo_sequence;
    peer_ = from;
    arm_ = arm;
    heard_ = 0;
    awaits_answer_ = false;
    refusal_ = "";
    round_trips_ns_.clear();
    next_round_trip_ = 0;
}

void BridgeHost::measure(std::uint64_t round_trip_ns) {
    if (round_trips_ns_.size() < round_trips_kept) {
        round_trips_ns_.push_back(round_trip_ns);
        return;
    }
    round_trips_ns_[next_round_trip_] = round_trip_ns;
    next_round_trip_ = (next_round_trip_ + 1) % round_trips_kept;
}

std::optional<double> BridgeHost::round_trip_median_s() const {
    if (round_trips_ns_.size() < round_trips_kept) return std::nullopt;
    std::vector<std::uint64_t> sorted = round_trips_ns_;
    const std::size_t rank = sorted.size() / 2;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank), sorted.end());
    return 1e-9 * static_cast<double>(sorted[rank]);
}

void BridgeHost::take_pose(const omb_header& header, const std::uint8_t* message, std::uint64_t now_ns) {
    omb_pose pose;
    omb_get_pose(message, &pose);
    if (header.sequence <= heard_) {
        ++counts_.out_of_order;
        return;
    }
    if (!is_possible(pose)) {
        ++counts_.impossible;
        return;
    }
    counts_.lost += heard_ == 0 ? 0 : header.sequence - heard_ - 1;
    heard_ = header.sequence;
    heard_ns_ = now_ns;
    request_clock_ns_ = header.clock_ns;
    awaits_answer_ = true;
    // Each end counts its own interval by its own clock, so the clocks need not agree. An arm whose clock
    // goes in steps, or fast, may claim that it kept the message for longer than it was away.
    const std::uint64_t away_ns = now_ns - pose.echo_clock_ns;
    const std::uint64_t kept_ns = std::min({away_ns, pose.kept_ns, longest_kept_ns});
    const std::uint64_t round_trip_ns = away_ns - kept_ns;
    const bool is_late = round_trip_ns > latest_round_trip_ns;
    is_answered_off_ = is_late || now_ns < acts_from_ns_;
    if (is_late) ++counts_.late;
    if (is_answered_off_) return;
    ++counts_.poses;
    measure(round_trip_ns);
    pose_ = pose;
    said_ns_ = pose.echo_clock_ns + kept_ns;
    has_fresh_pose_ = true;
}

BridgeMessage BridgeHost::answer(std::uint64_t now_ns, const BridgeForce& wanted) {
    awaits_answer_ = false;
    omb_force force{};
    force.is_off = wanted.is_off || is_answered_off_ ? 1 : 0;
    if (force.is_off == 0) {
        store(wanted.force_n, force.force_n);
        store(wanted.torque_n_mm, force.torque_n_mm);
    }
    force.echo_sequence = heard_;
    force.echo_clock_ns = request_clock_ns_;
    BridgeMessage message = begun(OMB_FORCE, session_, now_ns);
    omb_put_force(message.data(), &force);
    omb_seal(message.data(), &key_);
    return message;
}

std::optional<BridgeMessage> BridgeHost::take(std::span<const std::uint8_t> datagram, const PeerAddress& from,
                                              std::uint64_t now_ns) {
    has_fresh_pose_ = false;
    omb_header header;
    if (omb_get_header(datagram.data(), datagram.size(), &key_, &header) == 0) {
        ++counts_.refused;
        return std::nullopt;
    }
    if (header.kind == OMB_HELLO) return take_hello(datagram.data(), from, now_ns);
    if (header.kind == OMB_POSE && header.session != session_)
        try_to_join(header, datagram.data(), from, now_ns);
    if (session_ == 0 || header.session != session_ || from != peer_) {
        ++counts_.refused;
        return std::nullopt;
    }
    if (header.kind == OMB_POSE) {
        take_pose(header, datagram.data(), now_ns);
    } else if (header.kind == OMB_GOODBYE && header.sequence > heard_) {
        session_ = 0;
        awaits_answer_ = false;
    } else {
        ++counts_.refused;
    }
    return std::nullopt;
}

}  // namespace osteomill
