#include "render_client/link/client_outbox.h"

#include <utility>
#include <variant>

#include "common/wire/control_messages.h"
#include "common/wire/geometry_messages.h"
#include "common/wire/scene_messages.h"
#include "common/wire/session_info.h"

namespace osteomill {

void ClientOutbox::begin(const SessionInfo& session) {
    accepts_operator_ = session.accepts_operator;
    accepts_controls_ = session.accepts_controls;
    has_ct_ = session.has_ct;
    records_view_ = session.records_view;
    burr_count_ = session.burrs.size();
    owes_hello_ = true;
    view_.reset();
    owes_view_ = false;
}

void ClientOutbox::end() {
    *this = {};
}

void ClientOutbox::put(v2::OperatorInput input) {
    if (!accepts_operator_ ||
        !std::holds_alternative<OperatorCommand>(operator_command_from(input, burr_count_)))
        return;
    input.set_number(++input_number_);
    input_ = std::move(input);
}

void ClientOutbox::put(v2::SessionControl control) {
    if (accepts_controls_ && controls_.size() < most_waiting_controls)
        controls_.push_back(std::move(control));
}

void ClientOutbox::put(const Viewpoint& view) {
    if (view_ == view) return;
    view_ = view;
    owes_view_ = records_view_;
}

std::optional<v2::ClientFrame> ClientOutbox::next() {
    v2::ClientFrame frame;
    if (std::exchange(owes_hello_, false)) {
        frame.mutable_hello()->set_protocol_major(protocol_major);
        frame.mutable_hello()->set_protocol_minor(protocol_minor);
    } else if (request_) {
        *frame.mutable_compare_bone() = *std::exchange(request_, std::nullopt);
    } else if (std::exchange(owes_ct_request_, false)) {
        frame.mutable_ct_request();
    } else if (!controls_.empty()) {
        *frame.mutable_session_control() = std::move(controls_.front());
        controls_.pop_front();
    } else if (std::exchange(owes_view_, false)) {
        *frame.mutable_viewpoint() = to_message(*view_);
    } else if (input_) {
        *frame.mutable_operator_input() = *std::exchange(input_, std::nullopt);
    } else {
        return std::nullopt;
    }
    frame.set_sequence(++frame_sequence_);
    return frame;
}

}  // namespace osteomill
