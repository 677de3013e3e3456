#include "analysis/report/session_trace.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <numeric>

#include "common/bone/bone_ray.h"
#include "common/bone/structure_mask.h"
#include "common/recording/pcap_file.h"
#include "common/recording/playhead.h"

namespace osteomill {

namespace {

/// Sums the changes since `kept`, and then makes `kept` equal to `now`.
std::vector<TissueLevels> take_over(const std::vector<BrickChange>& changes, const Bone& now, Bone& kept,
                                    StructureWatch& structures) {
    std::array<TissueLevels, 256> sums{};
    for (const BrickChange& change : changes) {
        const std::int32_t slot = now.slot(change.brick);
        if (slot == BoneContent::no_slot) continue;
        const auto left = now.fractions(slot);
        const auto before = kept.fractions(slot);
        structures.note(change, before, left, now.content().tissues_of(slot));
        change.voxels.for_each([&](std::size_t voxel) {
            const int lost = int{before[voxel]} - int{left[voxel]};
            TissueLevels& levels = sums[now.content().tissue_in(slot, voxel)];
            if (change.kind == ChangeKind::milled)
                levels.milled += lost;
            else
                levels.restored -= lost;
            before[voxel] = left[voxel];
        });
    }
    std::vector<TissueLevels> changed;
    for (std::size_t label = 0; label < sums.size(); ++label)
        if (sums[label].milled != 0 || sums[label].restored != 0) {
            sums[label].tissue = static_cast<std::uint8_t>(label);
            changed.push_back(sums[label]);
        }
    return changed;
}

/// By the bone on a sphere of twice the burr's radius.
std::optional<double> spindle_to_surface_deg(const Bone& bone, const SessionTrace& trace,
                                             const ToolState& tool) {
    const auto normal = normal_about(bone, tool.burr_position_mm, trace.session.burrs[tool.burr].diameter_mm);
    const double length = glm::length(tool.spindle_axis);
    if (!normal || !(length > 0.0)) return std::nullopt;
    return glm::degrees(std::asin(std::clamp(glm::dot(*normal, tool.spindle_axis) / length, -1.0, 1.0)));
}

/// Moments of the frame that is to follow the trace's samples.
std::vector<TraceMoment> moments_of(const Playhead& playhead, const SessionTrace& trace) {
    const ToolState& tool = *playhead.tool();
    std::vector<TraceMoment> moments;
    double before_s = trace.samples.empty() ? tool.time_s : trace.samples.back().moments.back().time_s;
    const auto add = [&](double time_s, double force_n, double depth_mm, bool spindle_on) {
        time_s = std::max(time_s, before_s);
        moments.push_back({time_s, time_s - before_s, force_n, depth_mm, spindle_on});
        before_s = time_s;
    };
    for (const TickSample& tick : playhead.ticks())
        add(tick.time_s, glm::length(tick.force_n), tick.depth_mm, tick.spindle_on);
    if (moments.empty())
        add(tool.time_s, glm::length(tool.force_n), tool.depth_mm.value_or(0.0), tool.spindle_on);
    return moments;
}

/// The tool's places in the frame, by its ticks if there are any.
std::vector<ToolMoment> tool_moments_of(const Playhead& playhead) {
    const std::vector<Burr>& burrs = playhead.session().burrs;
    std::vector<ToolMoment> moments;
    for (const TickSample& tick : playhead.ticks())
        if (tick.burr < burrs.size())
            moments.push_back({tick.time_s, tick.burr_mm, tick.spindle_axis, burrs[tick.burr].radius_mm(),
                               tick.spindle_on});
    const ToolState& tool = *playhead.tool();
    if (moments.empty())
        moments.push_back({tool.time_s, tool.burr_position_mm, glm::normalize(tool.spindle_axis),
                           burrs[tool.burr].radius_mm(), tool.spindle_on});
    return moments;
}

/// State kept from the frames before.
struct Watches {
    StructureWatch structures;
    PlungeWatch plunges{};
};

/// Until the end is reached, the trace's bone is that of the frame before.
void add_sample(SessionTrace& trace, Playhead& playhead, Watches& watches) {
    StructureWatch& structures = watches.structures;
    const ToolState& tool = *playhead.tool();
    if (trace.samples.empty()) trace.began_unix_ns = tool.taken_unix_ns;
    const bool is_placed = std::ranges::any_of(playhead.state().events, [](const ControlEvent& event) {
        return event.action == SessionAction::place && !event.is_refused;
    });
    trace.samples.push_back(
        {.time_s = tool.time_s,
         .hand_mm = tool.hand_position_mm,
         .burr_mm = tool.burr_position_mm,
         .spindle_axis = tool.spindle_axis,
         .force_n = glm::length(tool.force_n),
         .depth_mm = tool.depth_mm.value_or(0.0),
         .burr = tool.burr,
         .spindle_on = tool.spindle_on,
         .is_paused = playhead.state().status.is_paused,
         .is_placed = is_placed,
         .moments = moments_of(playhead, trace),
         .levels = take_over(playhead.take_changes(), playhead.bone(), trace.at_end, structures)});
    TraceSample& sample = trace.samples.back();
    if (sample.cuts()) {
        sample.spindle_to_surface_deg = spindle_to_surface_deg(playhead.bone(), trace, tool);
        if (const auto& view = playhead.state().view)
            sample.burr_in_view =
                is_burr_in_view(playhead.bone(), trace.session.tissues, *view, tool.burr_position_mm);
    }
    structures.update(tool);
    sample.distances = structures.distances();
    if (sample.is_paused || trace.is_discontinuous(trace.samples.size() - 1))
        watches.plunges.forget();
    else
        watches.plunges.update(playhead.bone(), tool_moments_of(playhead), sample.cuts());
    if (tool.peak_force_n) trace.peak_force_n = tool.peak_force_n;
    trace.events.insert(trace.events.end(), playhead.state().events.begin(), playhead.state().events.end());
}

/// Start of a session on the virtual clock, whose frames do not hold the time of day.
std::int64_t recorded_unix_ns(const std::filesystem::path& file) {
    const auto first = PacketReader(file).next();
    return first ? std::chrono::nanoseconds(first->stamp.time_since_epoch()).count() : 0;
}

/// Watches all protected tissues. A tissue of which the recording holds no structure is where the bone bears
/// its label.
StructureWatch watch(SessionTrace& trace, std::vector<Structure> structures) {
    const SessionInfo& session = trace.session;
    for (std::size_t tissue = 0; tissue < session.tissues.size(); ++tissue) {
        const bool is_recorded =
            std::ranges::find(structures, tissue, &Structure::tissue) != structures.end();
        if (!session.tissues[tissue].is_protected || is_recorded) continue;
        StructureMask mask = structure_in_bone(trace.at_start, session.tissues[tissue].label);
        if (!mask.empty()) structures.push_back({tissue, std::move(mask)});
    }
    std::ranges::sort(structures, {}, &Structure::tissue);
    trace.structure_places = structures;
    return {std::move(structures), session.tissues, session.burrs};
}

SessionTrace begin(Playhead& playhead) {
    (void)playhead.take_changes();
    return {.session = playhead.session(), .at_start = playhead.bone(), .at_end = playhead.bone()};
}

}  // namespace

std::int64_t TraceSample::milled() const {
    return std::accumulate(levels.begin(), levels.end(), std::int64_t{0},
                           [](std::int64_t sum, const TissueLevels& l) { return sum + l.milled; });
}

std::int64_t TraceSample::restored() const {
    return std::accumulate(levels.begin(), levels.end(), std::int64_t{0},
                           [](std::int64_t sum, const TissueLevels& l) { return sum + l.restored; });
}

SessionTrace read_trace(const std::filesystem::path& file, const ReportProgress& on_frame) {
    Playhead playhead(file);
    SessionTrace trace = begin(playhead);
    std::optional<Watches> watches;  // from the first state on: the structures are known by then
    trace.error = play_to_end(playhead, on_frame, [&](Playhead::Step step) {
        if (step == Playhead::Step::state) {
            if (!watches) watches = Watches{watch(trace, playhead.structures())};
            add_sample(trace, playhead, *watches);
        }
        if (step == Playhead::Step::goodbye) trace.ends = true;
        if (step == Playhead::Step::new_bone) {
            trace = begin(playhead);
            watches.reset();
        }
    });
    if (trace.began_unix_ns == 0) trace.began_unix_ns = recorded_unix_ns(file);
    if (!watches) watches = Watches{watch(trace, playhead.structures())};
    (void)take_over(playhead.take_changes(), playhead.bone(), trace.at_end, watches->structures);
    trace.structures = watches->structures.accounts();
    trace.breakthroughs = watches->plunges.breakthroughs();
    trace.bone_checksum = playhead.bone_checksum();
    return trace;
}

std::optional<glm::dvec3> normal_about(const Bone& bone, const glm::dvec3& centre_mm, double radius_mm) {
    constexpr int directions = 256;
    constexpr double golden_angle = std::numbers::pi * (3.0 - 2.2360679774997896);
    constexpr double least_slope = 0.02;  // of the mean direction's length, 0.25 over a half space
    BoneSampler sampler(bone);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < directions; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / directions;
        const double across = std::sqrt(1.0 - z * z);
        const glm::dvec3 direction(across * std::cos(golden_angle * i), across * std::sin(golden_angle * i),
                                   z);
        const glm::dvec3 place = to_voxel_coordinates(bone.grid(), centre_mm + radius_mm * direction);
        sum -= sampler.between(place) / 255.0 * direction;
    }
    const double length = glm::length(sum);
    return length > least_slope * directions ? std::optional(sum / length) : std::nullopt;
}

namespace {

constexpr double least_hiding_opacity = 0.5;

bool is_in_picture(const Viewpoint& view, const glm::dvec3& apart_mm) {
    const glm::dvec3 seen = glm::conjugate(view.rotation) * apart_mm;  // right, down, forward
    const double half_height = std::tan(0.5 * view.field_of_view_rad);
    return seen.z > 0.0 && std::abs(seen.y) <= half_height * seen.z &&
           std::abs(seen.x) <= taken_picture_width * half_height * seen.z;
}

}  // namespace

bool is_burr_in_view(const Bone& bone, const std::vector<Tissue>& tissues, const Viewpoint& view,
                     const glm::dvec3& burr_mm) {
    const glm::dvec3 apart_mm = burr_mm - view.eye_mm;
    const double distance_mm = glm::length(apart_mm);
    if (!(distance_mm > 0.0)) return true;
    if (!std::isfinite(distance_mm) || !is_in_picture(view, apart_mm)) return false;
    const Grid& grid = bone.grid();
    const BoneRay ray{to_voxel_coordinates(grid, view.eye_mm), apart_mm / distance_mm};
    RaySpan span = span_within(ray, grid);
    span = {std::max(0.0, span.from), std::min(distance_mm / grid.spacing_mm, span.to)};
    if (span.is_empty()) return true;
    const auto hides = [&](double t) {
        const std::uint8_t label = bone.tissue_at(glm::ivec3(glm::floor(ray.at(t) + 0.5)));
        const auto tissue = std::ranges::find(tissues, label, &Tissue::label);
        return tissue == tissues.end() || tissue->opacity >= least_hiding_opacity;
    };
    return !BoneSampler(bone).first_surface(ray, span, hides);
}

}  // namespace osteomill
