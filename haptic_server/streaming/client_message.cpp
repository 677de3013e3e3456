#include "haptic_server/streaming/client_message.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/wire/control_messages.h"
#include "common/wire/geometry_messages.h"
#include "common/wire/scene_messages.h"
#include "common/wire/session_info.h"

namespace osteomill {

void AnsweredStates::sent(std::uint64_t number, Time now) {
    states_.push_back({number, now});
    while (states_.size() > most_kept || now - states_.front().true_until > longest_age) states_.pop_front();
}

void AnsweredStates::still_true(Time now) {
    if (!states_.empty()) states_.back().true_until = now;
}

AnsweredStates::Answer AnsweredStates::judge(std::uint64_t input_number, std::uint64_t state_number,
                                             Time now) {
    is_news_ = false;
    if (state_number != 0 && input_number <= last_input_) return Answer::repeated;
    last_input_ = std::max(last_input_, input_number);
    const Answer answer = judge_new(state_number, now);
    is_news_ = answer != last_answer_;
    last_answer_ = answer;
    return answer;
}

AnsweredStates::Answer AnsweredStates::judge_new(std::uint64_t state_number, Time now) const {
    if (state_number == 0) return Answer::unnamed;
    if (states_.empty() || state_number > states_.back().number) return Answer::unsent;
    const auto state = std::ranges::lower_bound(states_, state_number, {}, &State::number);
    const bool is_fresh = state->number == state_number && now - state->true_until <= longest_age;
    return is_fresh ? Answer::fresh : Answer::stale;
}

std::optional<WireError> check_greeting(const v2::ClientFrame& frame) {
    if (!frame.has_hello()) return WireError{"it did not begin with a hello"};
    // One that states none has read the server's, and goes by that.
    const std::uint32_t major = frame.hello().protocol_major();
    if (major == 0 || major == protocol_major) return std::nullopt;
    return WireError{fmt::format("it speaks protocol {}, this server {}: update the older of the two", major,
                                 protocol_major)};
}

std::variant<std::optional<Answer>, WireError> take_client_message(const v2::ClientFrame& frame,
                                                                   const MessagingClient& client,
                                                                   ToolLease::Time now) {
    if (frame.has_compare_bone()) {
        if (auto error = client.outgoing.compare(frame.compare_bone())) return *std::move(error);
        return std::nullopt;
    }
    if (frame.has_ct_request()) {
        client.outgoing.ask_for_ct();
        return std::nullopt;
    }
    if (frame.has_viewpoint()) {
        const auto view = viewpoint_from(frame.viewpoint());
        if (const auto* error = std::get_if<WireError>(&view)) return *error;
        if (client.view != nullptr) *client.view = std::get<Viewpoint>(view);
        return std::nullopt;
    }
    if (frame.has_session_control()) {
        const auto control = session_control_from(frame.session_control());
        if (const auto* error = std::get_if<WireError>(&control)) return *error;
        const auto& request = std::get<SessionControl>(control);
        if (client.control != nullptr) {
            (*client.control)(request);
        } else {
            const ControlEvent refused{.action = request.action,
                                       .text = "this client may not control the session, or another does",
                                       .is_refused = true};
            client.outgoing.tell(refused);
        }
        return std::nullopt;
    }
    if (!frame.has_operator_input()) return WireError{"it sent a frame that has no place there"};
    const auto command = operator_command_from(frame.operator_input(), client.burr_count);
    if (const auto* error = std::get_if<WireError>(&command)) return *error;
    if (client.lease == nullptr) return std::nullopt;
    const v2::OperatorInput& input = frame.operator_input();
    const Answer answer = client.answers.judge(input.number(), input.answers_state(), now);
    if (answer == Answer::unsent)
        return WireError{
            fmt::format("its input answers state {}, which it was not sent", input.answers_state())};
    if (answer == Answer::fresh) client.lease->take_input(client.id, std::get<OperatorCommand>(command), now);
    return client.answers.is_news() ? std::optional(answer) : std::nullopt;
}

std::string reason_to_ignore(Answer answer) {
    switch (answer) {
        case Answer::stale:
            return fmt::format(
                "moves nothing: its input answers what was so more than {} ms ago; its link "
                "is slow or late",
                AnsweredStates::longest_age.count());
        case Answer::unnamed:
            return "looks on and moves nothing: its input does not say which state it has seen";
        case Answer::fresh:
        case Answer::repeated:
        case Answer::unsent:
            return {};
    }
    return {};
}

}  // namespace osteomill
