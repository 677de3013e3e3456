#include "slicer/slicer_session.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "common/bone/patient_space.h"
#include "common/log/log.h"
#include "common/text/foreign_text.h"
#include "common/text/words.h"

namespace osteomill {

void ImageSchedule::restart(const ReducedBox& whole) {
    *this = {};
    whole_ = whole;
}

void ImageSchedule::changed(const ReducedBox& box, double now_s) {
    last_change_s_ = now_s;
    has_changed_since_whole_ = true;
    // Changes that were not sent yet become one part.
    if (!changes_.empty() && !changes_.back().first_sent_s)
        changes_.back().box = around(changes_.back().box, box);
    else
        changes_.push_back({box});
}

ReducedBox ImageSchedule::send_whole(double now_s) {
    whole_sent_s_ = last_sent_s_ = now_s;
    has_changed_since_whole_ = false;
    // A part that follows may replace the whole before the whole is imported.
    for (Change& change : changes_)
        if (!change.first_sent_s) change.first_sent_s = now_s;
    return *whole_;
}

std::optional<ReducedBox> ImageSchedule::next(double now_s) {
    if (!whole_) return std::nullopt;
    if (!whole_sent_s_) {
        begun_s_ = now_s;
        return send_whole(now_s);
    }
    if (has_changed_since_whole_ &&
        (now_s - last_change_s_ >= rests_after_s || now_s - *whole_sent_s_ >= between_wholes_s))
        return send_whole(now_s);
    while (!changes_.empty() && changes_.front().first_sent_s &&
           now_s - *changes_.front().first_sent_s > covered_s)
        changes_.pop_front();
    const bool has_news = !changes_.empty() && !changes_.back().first_sent_s;
    if (!has_news || now_s - last_sent_s_ < between_parts_s) return std::nullopt;
    // A part that replaced the first whole would leave the receiver's image incomplete.
    if (now_s - begun_s_ < covered_s) return send_whole(now_s);
    last_sent_s_ = now_s;
    ReducedBox box = changes_.front().box;
    for (Change& change : changes_) {
        box = around(box, change.box);
        if (!change.first_sent_s) change.first_sent_s = now_s;
    }
    return box;
}

namespace {

nlohmann::json numbers_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Three or six numbers in RAS, as a pose in LPS.
ToolPose pose_of(const std::string& text, const glm::dvec3& axis) {
    std::vector<double> numbers;
    for (const std::string& word : words_of(text)) {
        const auto number = finite_number(word);
        if (!number) throw std::invalid_argument(fmt::format("Place: '{}' is no number", word));
        numbers.push_back(*number);
    }
    if (numbers.size() != 3 && numbers.size() != 6)
        throw std::invalid_argument("Place: give \"x y z\" or \"x y z ax ay az\" in RAS, mm");
    ToolPose pose{.position_mm = {}, .spindle_axis = axis};
    pose.position_mm = ras_to_lps({numbers[0], numbers[1], numbers[2]});
    if (!is_place(pose.position_mm))
        throw std::invalid_argument("Place: farther than ten metres from the patient's origin");
    if (numbers.size() == 6) {
        const auto direction = unit_direction(ras_to_lps({numbers[3], numbers[4], numbers[5]}));
        if (!direction) throw std::invalid_argument("Place: the axis has no direction");
        pose.spindle_axis = *direction;
    }
    return pose;
}

}  // namespace

std::string session_text(const SessionInfo& session, const ToolState& tool, const SessionStatus& status,
                         const std::vector<StructureDistance>& distances) {
    nlohmann::ordered_json text{
        {"time_s", tool.time_s},
        {"burr", tool.burr < session.burrs.size() ? session.burrs[tool.burr].name : ""},
        {"spindle_on", tool.spindle_on},
        {"force_n", numbers_of(lps_to_ras(tool.force_n))},
        {"removed_mm3", tool.removed_mm3},
        {"is_paused", status.is_paused},
        {"fault", tool.fault.text()},
    };
    auto& near = text["protected"] = nlohmann::ordered_json::array();
    for (const StructureDistance& distance : distances) {
        if (distance.tissue >= session.tissues.size()) continue;
        near.push_back({{"name", session.tissues[distance.tissue].name},
                        {"touches", distance.touches},
                        {"touched_s", distance.touched_s},
                        {"removed_mm3", distance.removed_mm3}});
        if (distance.distance_mm) near.back()["distance_mm"] = *distance.distance_mm;
    }
    return text.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

SessionControl control_of(const std::string& name, const std::string& text, const glm::dvec3& axis) {
    if (name == "Mark") {
        if (text.size() > SessionControl::longest_text)
            throw std::invalid_argument(fmt::format("Mark: {} bytes; a note has {} at most", text.size(),
                                                    SessionControl::longest_text));
        require_plain("Mark", text);
        return {.action = SessionAction::mark, .text = text};
    }
    if (name == "Pause" && (text == "1" || text == "0"))
        return {.action = text == "1" ? SessionAction::pause : SessionAction::resume};
    if (name == "Pause") throw std::invalid_argument("Pause: is neither 1 nor 0");
    if (name == "Place") return {.action = SessionAction::place, .pose = pose_of(text, axis)};
    throw std::invalid_argument(
        fmt::format("a STRING is named Mark, Pause or Place, not '{}'", one_line(name)));
}

SlicerSession::SlicerSession(BoneLink& link, std::uint16_t port)
    : link_(link),
      port_(port, {.connected = [this] { begin_image(); },
                   .said = [this](const std::string& name, const std::string& text) { obey(name, text); }}) {}

void SlicerSession::begin_image() {
    if (bone_) schedule_.restart(bone_->whole());
}

void SlicerSession::run_for(std::chrono::milliseconds time) {
    take_in(now_s());
    send_what_is_due(now_s());
    port_.run_for(time);
}

void SlicerSession::take_in(double now_s) {
    const LinkUpdate update = link_.poll();
    if (update.status_line != status_line_) {
        status_line_ = update.status_line;
        if (!status_line_.empty()) log_info("{}", status_line_);
    }
    for (const ControlEvent& event : update.events)
        if (event.is_refused) log_warning("{}: refused: {}", name_of(event.action), event.text);
    if (update.bone_replaced) {
        bone_.emplace(*link_.bone());
        if (bone_->voxels_a_voxel() > 1)
            log_info("the bone is sent with voxels of {:.3g} mm, the mean of {}^3", bone_->grid().spacing_mm,
                     bone_->voxels_a_voxel());
        begin_image();
    } else if (bone_) {
        if (const auto box = bone_->update(*link_.bone(), update.changes)) schedule_.changed(*box, now_s);
    }
    if (update.tool) tool_ = update.tool;
    controls_ = update.controls;
    distances_ = update.distances;
}

void SlicerSession::send_what_is_due(double now_s) {
    // While the receiver is held up nothing queues: a later message has later values.
    if (!port_.takes_more() || !bone_) return;
    if (const auto box = schedule_.next(now_s))
        port_.send(image_message("Bone", bone_->grid(), *box, bone_->values(*box)));
    if (!tool_ || link_.session() == nullptr || now_s - transforms_sent_s_ < between_transforms_s) return;
    transforms_sent_s_ = now_s;
    port_.send(transform_message("Patient", glm::dvec3(0.0), glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1)));
    port_.send(transform_message("Burr", tool_->burr_position_mm, axes_about(tool_->spindle_axis)));
    port_.send(string_message("Session", session_text(*link_.session(), *tool_, controls_, distances_)));
    const std::string fault(tool_->fault.text());
    port_.send(status_message("BurrStatus", fault.empty(), fault.empty() ? "the force is on" : fault));
}

void SlicerSession::obey(const std::string& name, const std::string& text) {
    const auto now = std::chrono::steady_clock::now();
    const auto warn = [&](const std::string& line) { log_.write(LogLevel::warning, line, now); };
    try {
        const SessionControl control =
            control_of(name, text, tool_ ? tool_->spindle_axis : glm::dvec3(0.0, 0.0, 1.0));
        if (!controls_.may_control)
            warn(fmt::format("{} of 3D Slicer: the server takes no controls of this client", name));
        else if (!controls_taken_.take(now))
            warn(fmt::format("{} of 3D Slicer: too many at once; left out", name));
        else
            link_.send_control(control);
    } catch (const std::invalid_argument& error) {
        warn(fmt::format("3D Slicer: {}", error.what()));
    }
}

}  // namespace osteomill
