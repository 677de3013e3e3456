#include "analysis/hdf5/all_of_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <glm/common.hpp>
#include <limits>
#include <type_traits>
#include <utility>

namespace osteomill {

namespace {

constexpr double not_said = std::numeric_limits<double>::quiet_NaN();

template <typename Optional>
double or_nan(const Optional& value) {
    return value ? static_cast<double>(*value) : not_said;
}

/// A column: one number of each row.
template <typename Row>
struct NumberOf {
    const char* name;
    const char* units;
    Hdf5Number stored;
    double (*of)(const Row& row);
};
using StateNumber = NumberOf<SessionState>;
using DistanceNumber = NumberOf<StructureDistance>;

using S = SessionState;
using enum Hdf5Number;

constexpr std::array state_numbers{
    StateNumber{"session_time_s", "s", f8, [](const S& s) { return s.tool.time_s; }},
    StateNumber{"burr", "", i4, [](const S& s) { return static_cast<double>(s.tool.burr); }},
    StateNumber{"spindle_on", "", u1, [](const S& s) { return s.tool.spindle_on ? 1.0 : 0.0; }},
    StateNumber{"spindle_rpm", "1/min", f8, [](const S& s) { return or_nan(s.tool.spindle_rpm); }},
    StateNumber{"removed_mm3", "mm^3", f8, [](const S& s) { return s.tool.removed_mm3; }},
    StateNumber{"depth_mm", "mm", f8, [](const S& s) { return or_nan(s.tool.depth_mm); }},
    StateNumber{"peak_force_n", "N", f8, [](const S& s) { return or_nan(s.tool.peak_force_n); }},
    StateNumber{"touches_protected", "", u1, [](const S& s) { return s.tool.touches_protected ? 1.0 : 0.0; }},
    StateNumber{"cut_force_n", "N", f8,
                [](const S& s) { return s.tool.cut ? s.tool.cut->force_n : not_said; }},
    StateNumber{"cut_tooth_ripple_n", "N", f8,
                [](const S& s) { return s.tool.cut ? s.tool.cut->tooth_ripple_n : not_said; }},
    StateNumber{"cut_relative_stiffness", "1", f8,
                [](const S& s) { return s.tool.cut ? s.tool.cut->relative_stiffness : not_said; }},
    StateNumber{"cut_loaded_rpm", "1/min", f8,
                [](const S& s) { return s.tool.cut ? or_nan(s.tool.cut->loaded_rpm) : not_said; }},
    StateNumber{"solve_max_residual_n", "N", f8,
                [](const S& s) { return s.tool.solve ? s.tool.solve->max_residual_n : not_said; }},
    StateNumber{
        "solve_fallbacks", "", f8,
        [](const S& s) { return s.tool.solve ? static_cast<double>(s.tool.solve->fallbacks) : not_said; }},
    StateNumber{
        "solve_relaxed", "", f8,
        [](const S& s) { return s.tool.solve ? static_cast<double>(s.tool.solve->relaxed) : not_said; }},
    StateNumber{
        "solve_damped", "", f8,
        [](const S& s) { return s.tool.solve ? static_cast<double>(s.tool.solve->damped) : not_said; }},
    StateNumber{"driver", "", i4, [](const S& s) { return static_cast<double>(s.tool.driver); }},
    StateNumber{"undo_steps", "", i4, [](const S& s) { return static_cast<double>(s.status.undo_steps); }},
    StateNumber{"redo_steps", "", i4, [](const S& s) { return static_cast<double>(s.status.redo_steps); }},
    StateNumber{"is_paused", "", u1, [](const S& s) { return s.status.is_paused ? 1.0 : 0.0; }}};

struct StateVector {
    const char* name;
    const char* units;
    glm::dvec3 (*of)(const ToolState& tool);
};

constexpr std::array state_vectors{
    StateVector{"burr_mm", "mm", [](const ToolState& t) { return t.burr_position_mm; }},
    StateVector{"axis", "1", [](const ToolState& t) { return t.spindle_axis; }},
    StateVector{"hand_mm", "mm", [](const ToolState& t) { return t.hand_position_mm; }},
    StateVector{"force_n", "N", [](const ToolState& t) { return t.force_n; }},
    StateVector{"shank_torque_n_mm", "N mm",
                [](const ToolState& t) { return t.shank_torque_n_mm.value_or(glm::dvec3(not_said)); }}};

using D = StructureDistance;
constexpr std::array distance_numbers{
    DistanceNumber{"tissue", "", i4, [](const D& d) { return static_cast<double>(d.tissue); }},
    DistanceNumber{"distance_mm", "mm", f8, [](const D& d) { return or_nan(d.distance_mm); }},
    DistanceNumber{"touches", "", u1, [](const D& d) { return d.touches ? 1.0 : 0.0; }},
    DistanceNumber{"touches_so_far", "", i4,
                   [](const D& d) { return static_cast<double>(d.touches_so_far); }},
    DistanceNumber{"first_touch_s", "s", f8, [](const D& d) { return d.first_touch_s; }},
    DistanceNumber{"touched_s", "s", f8, [](const D& d) { return d.touched_s; }},
    DistanceNumber{"removed_mm3", "mm^3", f8, [](const D& d) { return d.removed_mm3; }},
    DistanceNumber{"entered_mm3", "mm^3", f8, [](const D& d) { return d.entered_mm3; }}};

std::array<double, 3> row(const glm::dvec3& vector) {
    return {vector.x, vector.y, vector.z};
}

void describe_plan(Hdf5File& file, const Plan& plan) {
    file.add_group("plan");
    file.set_attribute("plan", "margin_mm", plan.margin_mm);
    std::visit(
        [&file](const auto& region) {
            using Region = std::decay_t<decltype(region)>;
            if constexpr (std::is_same_v<Region, TissueRegion>) {
                file.set_attribute("plan", "tissue", region.tissue);
            } else {
                if constexpr (std::is_same_v<Region, SphereRegion>) {
                    file.set_attribute("plan", "centre_mm", row(region.centre_mm));
                } else {
                    file.set_attribute("plan", "from_mm", row(region.from_mm));
                    file.set_attribute("plan", "to_mm", row(region.to_mm));
                }
                file.set_attribute("plan", "radius_mm", region.radius_mm);
            }
        },
        plan.region);
}

}  // namespace

AllOfRecording::AllOfRecording(const std::filesystem::path& file, const Playhead& playhead, double began_s)
    : file_(file) {
    begin(playhead, began_s);
    write_bone(file_, "bone", playhead.bone());
    write_tissues(playhead.session().tissues);
    write_burrs(playhead.session().burrs);
    write_structures(playhead);
    begin_tables();
}

void AllOfRecording::begin(const Playhead& playhead, double began_s) {
    const SessionInfo& session = playhead.session();
    file_.set_attribute("/", "layout", "osteomill 1");
    file_.set_attribute("/", "space", "patient LPS: x to the left, y to the back, z up");
    file_.set_attribute("/", "began_unix_s", began_s);
    file_.set_attribute("/", "scene", session.scene_name);
    file_.set_attribute("/", "program_version", session.server_version);
    file_.set_attribute("/", "protocol",
                        fmt::format("{}.{}", session.protocol_major, session.protocol_minor));
    file_.set_attribute("/", "trainee", session.trainee);
    file_.set_attribute("/", "case", session.case_name);
    file_.set_attribute("/", "force_limit_n", session.force_limit_n);
    file_.add_group("settings");
    for (const auto& [name, value] : session.settings) file_.set_attribute("settings", name, value);
    if (!session.scene_toml.empty()) file_.set_attribute("settings", "scene_toml", session.scene_toml);
    if (session.plan) describe_plan(file_, *session.plan);
}

void AllOfRecording::write_tissues(const std::vector<Tissue>& tissues) {
    std::vector<std::string> names;
    auto& labels = bytes_.add("tissues/label", u1);
    auto& colours = bytes_.add("tissues/colour_rgb", u1, "", 3);
    auto& protections = bytes_.add("tissues/is_protected", u1);
    auto& opacities = numbers_.add("tissues/opacity", f8, "1");
    auto& warnings = numbers_.add("tissues/warn_mm", f8, "mm");
    auto& identifiers = bytes_.add("tissues/identifier_rgb", u1, "", 3);
    auto& depths = numbers_.add("tissues/shows_through_mm", f8, "mm");
    auto& strengths = numbers_.add("tissues/shows_through_strength", f8, "1");
    for (const Tissue& tissue : tissues) {
        names.push_back(tissue.name);
        labels.add(tissue.label);
        colours.add(tissue.colour_rgb);
        protections.add(std::uint8_t{tissue.is_protected});
        opacities.add(tissue.opacity);
        warnings.add(tissue.warn_mm);
        identifiers.add(identifier_of(tissue));
        depths.add(tissue.shows_through_mm);
        strengths.add(tissue.shows_through_strength);
    }
    file_.add_texts("tissues/name", names);
}

void AllOfRecording::write_burrs(const std::vector<Burr>& burrs) {
    std::vector<std::string> names;
    std::vector<std::string> shapes;
    auto& diameters = numbers_.add("burrs/diameter_mm", f8, "mm");
    auto& lengths = numbers_.add("burrs/length_mm", f8, "mm");
    auto& tips = numbers_.add("burrs/tip_diameter_mm", f8, "mm");
    auto& necks = numbers_.add("burrs/neck_diameter_mm", f8, "mm");
    auto& speeds = numbers_.add("burrs/spindle_rpm", f8, "1/min");
    auto& edges = whole_numbers_.add("burrs/edges", i4);
    auto& clockwise = bytes_.add("burrs/clockwise", u1);
    for (const Burr& burr : burrs) {
        names.push_back(burr.name);
        shapes.emplace_back(head_shape_names[static_cast<std::size_t>(burr.head.shape)]);
        diameters.add(burr.diameter_mm);
        lengths.add(burr.head.length_mm);
        tips.add(burr.head.tip_diameter_mm);
        necks.add(burr.head.neck_diameter_mm);
        speeds.add(60.0 * burr.spindle_rev_per_s);
        edges.add(burr.edges);
        clockwise.add(std::uint8_t{burr.sense == SpindleSense::clockwise});
    }
    file_.add_texts("burrs/name", names);
    file_.add_texts("burrs/shape", shapes);
}

void AllOfRecording::write_structures(const Playhead& playhead) {
    file_.add_group("structures");
    const glm::ivec3& size = playhead.bone().content().size_bricks;
    for (const Structure& structure : playhead.structures()) {
        const std::string group = fmt::format("structures/{}", structure.tissue);
        Hdf5Series<std::int64_t> voxels(file_, group + "/ijk", i4, "", 3);
        for (const StructureBrick& brick : structure.mask.bricks()) {
            const glm::ivec3 first = brick_edge_voxels * brick_position(size, brick.brick);
            brick.voxels.for_each([&](std::size_t offset) {
                const glm::ivec3 voxel = first + voxel_in_brick(offset);
                voxels.add(std::array<std::int64_t, 3>{voxel.x, voxel.y, voxel.z});
            });
        }
        voxels.close();
        file_.set_attribute(group, "tissue", playhead.session().tissues[structure.tissue].name);
    }
}

void AllOfRecording::begin_tables() {
    add_tick_columns(TickPart::always);
    numbers_.add("states/time_s", f8, "s");
    for (const StateNumber& number : state_numbers)
        numbers_.add(fmt::format("states/{}", number.name), number.stored, number.units);
    for (const StateVector& vector : state_vectors)
        numbers_.add(fmt::format("states/{}", vector.name), f8, vector.units, 3);
    whole_numbers_.add("states/taken_unix_ns", i8, "ns");
    whole_numbers_.add("states/missed_ticks", i8);
    whole_numbers_.add("distances/state", i8);
    for (const DistanceNumber& number : distance_numbers)
        numbers_.add(fmt::format("distances/{}", number.name), number.stored, number.units);
    numbers_.add("events/time_s", f8, "s");
    bytes_.add("events/is_refused", u1);
    whole_numbers_.add("bone/changes/state", i8);
    whole_numbers_.add("bone/changes/ijk", i4, "", 3);
    bytes_.add("bone/changes/fraction", u1);
    bytes_.add("bone/changes/is_restored", u1);
}

void AllOfRecording::add_tick_columns(TickPart part) {
    for (const TickQuantity& quantity : tick_quantities())
        if (quantity.part == part)
            numbers_.add(fmt::format("ticks/{}", quantity.name), quantity.decimals == 0 ? i4 : f8,
                         quantity.unit);
}

void AllOfRecording::add(const Playhead& playhead) {
    const SessionState& state = playhead.state();
    numbers_.at("states/time_s").add(playhead.time_s());
    for (const StateNumber& number : state_numbers)
        numbers_.at(fmt::format("states/{}", number.name)).add(number.of(state));
    for (const StateVector& vector : state_vectors)
        numbers_.at(fmt::format("states/{}", vector.name)).add(row(vector.of(state.tool)));
    whole_numbers_.at("states/taken_unix_ns").add(state.tool.taken_unix_ns);
    whole_numbers_.at("states/missed_ticks").add(static_cast<std::int64_t>(playhead.counts().missed_ticks));
    faults_.emplace_back(state.tool.fault.text());
    notices_.emplace_back(state.tool.notice.text());
    for (const StructureDistance& distance : state.distances) {
        whole_numbers_.at("distances/state").add(states_);
        for (const DistanceNumber& number : distance_numbers)
            numbers_.at(fmt::format("distances/{}", number.name)).add(number.of(distance));
    }
    for (const ControlEvent& event : state.events) {
        numbers_.at("events/time_s").add(event.time_s);
        bytes_.at("events/is_refused").add(std::uint8_t{event.is_refused});
        actions_.emplace_back(name_of(event.action));
        action_texts_.push_back(event.text);
    }
    add_ticks(playhead.ticks());
    add_changes(playhead);
    ++states_;
}

void AllOfRecording::add_ticks(const std::vector<TickSample>& ticks) {
    if (ticks.empty()) return;
    if (!has_torque_ && ticks.front().shank_torque_n_mm) {
        has_torque_ = true;
        add_tick_columns(TickPart::torque);
    }
    if (!has_input_ && ticks.front().input) {
        has_input_ = true;
        add_tick_columns(TickPart::input);
        add_tick_columns(TickPart::control);
    }
    std::vector<double> column(ticks.size());
    for (const TickQuantity& quantity : tick_quantities()) {
        const bool is_input = quantity.part == TickPart::input || quantity.part == TickPart::control;
        const bool is_column = quantity.part == TickPart::always ||
                               (quantity.part == TickPart::torque && has_torque_) || (is_input && has_input_);
        if (!is_column) continue;
        std::ranges::transform(ticks, column.begin(), quantity.of);
        numbers_.at(fmt::format("ticks/{}", quantity.name)).add(std::span<const double>(column));
    }
}

void AllOfRecording::add_changes(const Playhead& playhead) {
    const glm::ivec3& size = playhead.bone().content().size_bricks;
    auto& states = whole_numbers_.at("bone/changes/state");
    auto& voxels = whole_numbers_.at("bone/changes/ijk");
    auto& left = bytes_.at("bone/changes/fraction");
    auto& restored = bytes_.at("bone/changes/is_restored");
    for (const ChangedBrick& changed : playhead.changes()) {
        const BrickChange& change = changed.change;
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, change.brick);
        change.voxels.for_each([&](std::size_t offset) {
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            states.add(states_);
            voxels.add(std::array<std::int64_t, 3>{voxel.x, voxel.y, voxel.z});
            left.add(changed.fractions[offset]);
            restored.add(std::uint8_t{change.kind == ChangeKind::restored});
        });
    }
}

void AllOfRecording::close(const Playhead& playhead, bool is_complete) {
    file_.add_texts("states/fault", faults_);
    file_.add_texts("states/notice", notices_);
    file_.add_texts("events/action", actions_);
    file_.add_texts("events/text", action_texts_);
    file_.set_attribute("bone", "checksum_at_end", fmt::format("{:016x}", playhead.bone_checksum()));
    file_.set_attribute("/", "is_complete", is_complete ? 1.0 : 0.0);
    numbers_.close();
    whole_numbers_.close();
    bytes_.close();
    file_.commit();
}

namespace {

using Sizes = std::array<hsize_t, 3>;

Sizes sizes(const glm::ivec3& of) {
    return {static_cast<hsize_t>(of.x), static_cast<hsize_t>(of.y), static_cast<hsize_t>(of.z)};
}

/// `brick_of`: the bytes of a stored brick.
template <typename BrickOf>
void write_channel(Hdf5File& file, const std::string& path, const Bone& bone, const BrickOf& brick_of) {
    errno = 0;
    const glm::ivec3 size = bone.grid().size_voxels;
    const Sizes all = sizes(size);
    const Sizes chunk = sizes(glm::min(size, glm::ivec3(brick_edge_voxels)));
    const Hdf5Id in_file(file.check(H5Screate_simple(3, all.data(), nullptr)), H5Sclose);
    const Hdf5Id properties = file.dataset_properties();
    file.check(H5Pset_chunk(properties.get(), 3, chunk.data()));
    file.check(H5Pset_deflate(properties.get(), gzip_level));
    const Hdf5Id dataset(file.check(H5Dcreate2(file.id(), path.c_str(), H5T_STD_U8LE, in_file.get(),
                                               file.link_properties(), properties.get(), H5P_DEFAULT)),
                         H5Dclose);
    ByteBrick turned;
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(bone.content().size_bricks,
                                                                    bone.content().brick_of_slot[slot]);
        const glm::ivec3 here = glm::min(size - first, glm::ivec3(brick_edge_voxels));
        const auto& brick = brick_of(static_cast<std::int32_t>(slot));
        std::size_t next = 0;
        for (int i = 0; i < here.x; ++i)
            for (int j = 0; j < here.y; ++j)
                for (int k = 0; k < here.z; ++k) turned[next++] = brick[offset_in_brick({i, j, k})];
        const Sizes start = sizes(first);
        const Sizes count = sizes(here);
        const Hdf5Id in_memory(file.check(H5Screate_simple(3, count.data(), nullptr)), H5Sclose);
        file.check(
            H5Sselect_hyperslab(in_file.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
        file.check(H5Dwrite(dataset.get(), H5T_NATIVE_UINT8, in_memory.get(), in_file.get(), H5P_DEFAULT,
                            turned.data()));
    }
}

}  // namespace

void write_bone(Hdf5File& file, const std::string& group, const Bone& bone) {
    const BoneContent& content = bone.content();
    write_channel(file, group + "/fraction", bone, [&](std::int32_t slot) { return bone.fractions(slot); });
    if (!content.stiffness.empty())
        write_channel(file, group + "/stiffness", bone, [&](std::int32_t slot) -> const ByteBrick& {
            return content.stiffness[static_cast<std::size_t>(slot)];
        });
    if (!content.tissue.empty())
        write_channel(file, group + "/tissue", bone,
                      [&](std::int32_t slot) -> const ByteBrick& { return *content.tissues_of(slot); });
    const glm::dvec3& origin_mm = bone.grid().origin_mm;
    file.set_attribute(group, "spacing_mm", bone.grid().spacing_mm);
    file.set_attribute(group, "origin_mm", std::array{origin_mm.x, origin_mm.y, origin_mm.z});
    file.set_attribute(group, "relative_stiffness_per_code", content.stiffness_per_code);
    file.set_attribute(group, "homogeneous_relative_stiffness", content.homogeneous_stiffness);
}

}  // namespace osteomill
