#include "analysis/hdf5/fivrs_recording.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <system_error>
#include <utility>

#include "analysis/hdf5/recording_hdf5.h"

namespace osteomill {

namespace {

using enum Hdf5Number;

constexpr double m_per_mm = 1e-3;

constexpr const char* readme =
    "Written by Osteomill. Lengths in metres, times in seconds since 1970, poses T_world_obj as x y z qx qy "
    "qz qw. The world is the patient: LPS, x to the left, y to the back, z up. The drill's shank is its "
    "local "
    "+x, its burr is at its origin; the volume's origin is the centre of its grid. i, j, k count the voxels "
    "of the bone's own grid. A voxel is removed where less than half of it is left; bone that was given back "
    "is not among them. Force in N, on the hand, and torque in N m, of bone on the shank about the burr's "
    "centre, both in the world's axes. There are no images.";

/// The colour of bone in their programs.
constexpr std::array<std::uint8_t, 3> bone_rgb{255, 249, 219};

using Pose = std::array<double, 7>;

/// The shortest rotation of +x to the spindle's axis: how the handpiece is turned about it is not recorded.
Pose drill_pose(const ToolPose& burr) {
    const double length = glm::length(burr.spindle_axis);
    const glm::dvec3 axis = length > 0.0 ? burr.spindle_axis / length : glm::dvec3(1.0, 0.0, 0.0);
    glm::dvec4 rotation(0.0, -axis.z, axis.y, 1.0 + axis.x);
    if (glm::length(rotation) < 1e-6) rotation = {0.0, 0.0, 1.0, 0.0};  // half a turn
    rotation = glm::normalize(rotation);
    const glm::dvec3 position_m = m_per_mm * burr.position_mm;
    return {position_m.x, position_m.y, position_m.z, rotation.x, rotation.y, rotation.z, rotation.w};
}

Pose volume_pose(const Grid& grid) {
    const glm::dvec3 centre_m =
        m_per_mm * (grid.origin_mm + 0.5 * grid.spacing_mm * glm::dvec3(grid.size_voxels - 1));
    return {centre_m.x, centre_m.y, centre_m.z, 0.0, 0.0, 0.0, 1.0};
}

bool is_removed(std::uint8_t fraction) {
    return 2 * fraction < 255;
}

}  // namespace

FivrsRecording::FivrsRecording(const std::filesystem::path& file, const Playhead& playhead, double began_s,
                               bool with_v3)
    : file_(file), began_s_(began_s), at_start_(playhead.bone()) {
    if (with_v3) {
        // If something stands in the way, opening the file reports it.
        std::error_code ignored;
        std::filesystem::create_directory(fivrs_v3_file(file).parent_path(), ignored);
        v3_.emplace(fivrs_v3_file(file));
    }
    write_metadata(at_start_.grid());
    numbers_.add("data/time", f8, "s");
    numbers_.add("data/pose_mastoidectomy_drill", f8, "", 7);
    numbers_.add("data/pose_mastoidectomy_volume", f8, "", 7);
    numbers_.add("burr_change/time_stamp", f8, "s");
    numbers_.add("burr_change/burr_size", i8, "mm");
    numbers_.add("drill_force_feedback/time_stamp", f8, "s");
    numbers_.add("drill_force_feedback/wrench", f8, "N, N m", 6);
    // One dimension each: their programs take the length of whatever is in a group.
    numbers_.add("osteomill/time_stamp", f8, "s");
    numbers_.add("osteomill/removed_mm3", f8, "mm^3");
    numbers_.add("osteomill/burr_diameter_mm", f8, "mm");
    if (v3_) begin_v3();
}

void FivrsRecording::write_metadata(const Grid& grid) {
    file_.add_number("metadata/voxel_volume", voxel_volume_mm3(grid));
    file_.set_attribute("metadata/voxel_volume", "units", "mm^3, millimeters cubed");
    file_.add_text("metadata/README", readme);
}

void FivrsRecording::begin_v3() {
    const std::filesystem::path old = std::filesystem::path("..") / file_.path().filename();
    const auto link = [&](const std::string& path, const std::string& target) {
        v3_->add_link(path, old, target);
    };
    for (const std::string name : {"voxel_volume", "README"})
        link("metadata_v3/" + name, "/metadata/" + name);
    for (const std::string name : {"time", "pose_mastoidectomy_drill", "pose_mastoidectomy_volume"})
        link("vision_data/continuous_data/" + name, "/data/" + name);
    v3_->add_group("vision_data/intermittent_data");
    const std::string physics = "physics_data/intermittent_data/";
    for (const std::string name : {"voxel_time_stamp", "voxel_removed", "voxel_color"})
        link(physics + "voxels_removed/" + name, "/voxels_removed/" + name);
    v3_->add_text(physics + "voxels_removed/README", readme);
    for (const std::string name : {"burr_change", "drill_force_feedback"}) link(physics + name, "/" + name);
    poses_.emplace(*v3_);
    const std::string poses = "physics_data/continuous_data/high_frequency_poses/";
    for (const std::string object : {"mastoidectomy_drill_pose/", "mastoidectomy_volume_pose/"}) {
        poses_->add(poses + object + "time_stamp", f8, "s");
        poses_->add(poses + object + "pose", f8, "", 7);
    }
}

void FivrsRecording::add(const Playhead& playhead) {
    const ToolState& tool = *playhead.tool();
    const double began_s = began_s_ + playhead.time_s() - tool.time_s;  // the session's time is then zero
    // Several states at one time are one row: readers expect time to go on.
    if (row_times_s_.empty() || began_s + tool.time_s > row_times_s_.back()) add_row(playhead);
    for (const TickSample& tick : playhead.ticks())
        add_force(began_s + tick.time_s, tick.force_n, tick.shank_torque_n_mm,
                  {tick.burr_mm, tick.spindle_axis});
    if (playhead.ticks().empty())
        add_force(began_s + tool.time_s, tool.force_n, tool.shank_torque_n_mm,
                  {tool.burr_position_mm, tool.spindle_axis});
    note_removed(playhead);
}

void FivrsRecording::add_row(const Playhead& playhead) {
    const ToolState& tool = *playhead.tool();
    const double time_s = began_s_ + playhead.time_s();
    row_times_s_.push_back(time_s);
    numbers_.at("data/time").add(time_s);
    numbers_.at("data/pose_mastoidectomy_drill").add(drill_pose({tool.burr_position_mm, tool.spindle_axis}));
    numbers_.at("data/pose_mastoidectomy_volume").add(volume_pose(at_start_.grid()));
    const double diameter_mm = playhead.session().burrs[tool.burr].diameter_mm;
    if (burr_ != tool.burr) {
        numbers_.at("burr_change/time_stamp").add(time_s);
        numbers_.at("burr_change/burr_size").add(std::round(diameter_mm));
        burr_ = tool.burr;
    }
    numbers_.at("osteomill/time_stamp").add(time_s);
    numbers_.at("osteomill/removed_mm3").add(tool.removed_mm3);
    numbers_.at("osteomill/burr_diameter_mm").add(diameter_mm);
}

void FivrsRecording::add_force(double time_s, const glm::dvec3& force_n,
                               const std::optional<glm::dvec3>& torque_n_mm, const ToolPose& burr) {
    if (time_s <= last_force_s_) return;
    last_force_s_ = time_s;
    const glm::dvec3 torque_n_m = m_per_mm * torque_n_mm.value_or(glm::dvec3(0.0));
    numbers_.at("drill_force_feedback/time_stamp").add(time_s);
    numbers_.at("drill_force_feedback/wrench")
        .add(std::array{force_n.x, force_n.y, force_n.z, torque_n_m.x, torque_n_m.y, torque_n_m.z});
    if (!poses_) return;
    const std::string poses = "physics_data/continuous_data/high_frequency_poses/";
    for (const auto& [object, pose] :
         {std::pair{"mastoidectomy_drill_pose/", drill_pose(burr)},
          std::pair{"mastoidectomy_volume_pose/", volume_pose(at_start_.grid())}}) {
        poses_->at(poses + object + "time_stamp").add(time_s);
        poses_->at(poses + object + "pose").add(pose);
    }
}

void FivrsRecording::note_removed(const Playhead& playhead) {
    const glm::uvec3 size(at_start_.grid().size_voxels);
    for (const ChangedBrick& changed : playhead.changes()) {
        const std::int32_t slot = at_start_.slot(changed.change.brick);
        if (slot == BoneContent::no_slot) continue;
        const BrickFractions before = at_start_.fractions(slot);
        const glm::ivec3 first =
            brick_edge_voxels * brick_position(at_start_.content().size_bricks, changed.change.brick);
        changed.change.voxels.for_each([&](std::size_t offset) {
            if (is_removed(before[offset])) return;
            const glm::uvec3 voxel(first + voxel_in_brick(offset));
            const std::uint64_t number =
                voxel.x + std::uint64_t{size.x} * (voxel.y + std::uint64_t{size.y} * voxel.z);
            if (is_removed(changed.fractions[offset]))
                removed_.try_emplace(number, row_times_s_.size() - 1);
            else
                removed_.erase(number);
        });
    }
}

void FivrsRecording::write_removed(const std::vector<Tissue>& tissues) {
    auto& times = numbers_.add("voxels_removed/voxel_time_stamp", f8, "s");
    auto& voxels = numbers_.add("voxels_removed/voxel_removed", f8, "", 4);
    auto& colours = numbers_.add("voxels_removed/voxel_color", f8, "", 5);
    std::array<std::array<std::uint8_t, 3>, 256> rgb_of_label;
    rgb_of_label.fill(bone_rgb);
    for (const Tissue& tissue : tissues) rgb_of_label[tissue.label] = identifier_of(tissue);
    std::vector<std::pair<std::size_t, std::uint64_t>> removed;
    for (const auto& [number, row] : removed_) removed.emplace_back(row, number);
    std::ranges::sort(removed);
    const glm::uvec3 size(at_start_.grid().size_voxels);
    std::optional<std::size_t> last_row;
    for (const auto& [row, number] : removed) {
        if (last_row != row) times.add(row_times_s_[row]);
        last_row = row;
        const auto message = static_cast<double>(times.rows() - 1);
        const glm::ivec3 voxel(number % size.x, number / size.x % size.y, number / size.x / size.y);
        voxels.add(std::array<double, 4>{message, static_cast<double>(voxel.x), static_cast<double>(voxel.y),
                                         static_cast<double>(voxel.z)});
        const auto& rgb = rgb_of_label[at_start_.tissue_at(voxel)];
        colours.add(std::array<double, 5>{message, static_cast<double>(rgb[0]), static_cast<double>(rgb[1]),
                                          static_cast<double>(rgb[2]), 255.0});
    }
}

void FivrsRecording::close(const Playhead& playhead, bool is_complete) {
    write_removed(playhead.session().tissues);
    file_.set_attribute("/", "is_complete", is_complete ? 1.0 : 0.0);
    numbers_.close();
    file_.commit();
    if (!v3_) return;
    poses_->close();
    v3_->commit();
}

}  // namespace osteomill
