// Scene and tool as a client sees them, in and out of messages.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "common/scene/scene.h"
#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "common/wire/frame.h"
#include "common/wire/session_info.h"
#include "osteomill/v2/session.pb.h"
#include "osteomill/v2/tool.pb.h"

namespace osteomill {

v2::BurrDescription to_message(const Burr& burr);
v2::TissueDescription to_message(const Tissue& tissue);
v2::ToolState to_message(const ToolState& tool);
v2::Hello to_message(const SessionInfo& session);
v2::OperatorInput to_message(const OperatorCommand& command);

/// Burrs as a client knows them: the cutting coefficients are not sent, and zero here. Refuses a list without
/// burrs and a size or speed that is not finite and above zero.
std::variant<std::vector<Burr>, WireError> burrs_from(
    const google::protobuf::RepeatedPtrField<v2::BurrDescription>& messages);

/// Refuses a label that is not 1 to 255 and a colour past 0xFFFFFF.
std::variant<std::vector<Tissue>, WireError> tissues_from(
    const google::protobuf::RepeatedPtrField<v2::TissueDescription>& messages);

/// Refuses as the functions above, and a force limit that is no finite number of newtons. The protocol's
/// version is taken as it is.
std::variant<SessionInfo, WireError> session_info_from(const v2::Hello& hello);

/// Refuses numbers that are not finite and a burr that is not one of `burr_count`.
std::variant<ToolState, WireError> tool_from(const v2::ToolState& message, std::size_t burr_count);

/// Refuses numbers that are not finite, an axis of no length (any other is made a unit vector), and a burr
/// that is not one of `burr_count`.
std::variant<OperatorCommand, WireError> operator_command_from(const v2::OperatorInput& message,
                                                               std::size_t burr_count);

}  // namespace osteomill
