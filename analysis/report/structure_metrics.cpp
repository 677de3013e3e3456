#include "analysis/report/structure_metrics.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <map>
#include <numbers>

#include "analysis/report/voxel_set.h"

namespace osteomill {

std::vector<StructureMetrics> structure_metrics(const SessionTrace& trace) {
    std::vector<StructureMetrics> all;
    const std::vector<Tissue>& tissues = trace.session.tissues;
    for (std::size_t tissue = 0; tissue < tissues.size(); ++tissue) {
        if (!tissues[tissue].is_protected) continue;
        StructureMetrics metrics{.name = tissues[tissue].name};
        const auto account = std::ranges::find(trace.structures, tissue,
                                               [](const StructureAccount& one) { return one.last.tissue; });
        if (account != trace.structures.end()) {
            const StructureDistance& last = account->last;
            if (account->nearest_mm) metrics.nearest_mm = std::max(0.0, *account->nearest_mm);
            metrics.touches = last.touches_so_far;
            if (metrics.touches > 0) metrics.first_touch_s = last.first_touch_s;
            metrics.touched_s = last.touched_s;
            metrics.dose_mm3 = last.removed_mm3;
            metrics.undone_dose_mm3 = account->given_back_mm3;
            metrics.entered_mm3 = last.entered_mm3;
        }
        all.push_back(std::move(metrics));
    }
    return all;
}

namespace {

constexpr double leaves_within_voxels = 2.0;

/// The cavity and the questions asked of it, in a box beyond which it exposes nothing.
class BareSurface {
  public:
    explicit BareSurface(const SessionTrace& trace)
        : grid_(trace.at_start.grid()),
          cavity_(cavity_of(trace.at_start, trace.at_end)),
          surface_mm_(cavity_.surface_mm()),
          nearest_(surface_mm_) {
        if (surface_mm_.empty()) return;
        low_ = high_ = surface_mm_.front();
        for (const glm::dvec3& place : surface_mm_)
            low_ = glm::min(low_, place), high_ = glm::max(high_, place);
        const double reach_mm = thin_mm.back() + grid_.spacing_mm;
        low_ -= reach_mm, high_ += reach_mm;
    }

    /// Thickness of the bone over a voxel of a structure's surface; nothing: none that matters, or none on
    /// this side.
    std::optional<double> thickness_mm(const StructureMask& structure, const glm::ivec3& voxel) const {
        if (cavity_.contains(voxel)) return 0.0;
        const glm::dvec3 place_mm = centre_of_voxel_mm(grid_, voxel);
        if (surface_mm_.empty() || glm::any(glm::lessThan(place_mm, low_)) ||
            glm::any(glm::greaterThan(place_mm, high_)))
            return std::nullopt;
        const glm::dvec3 way_mm = *nearest_.nearest_mm(place_mm) - place_mm;
        const double length_mm = glm::length(way_mm);
        if (length_mm > thin_mm.back() + grid_.spacing_mm) return std::nullopt;
        for (double at_mm = leaves_within_voxels * grid_.spacing_mm; at_mm < length_mm;
             at_mm += 0.5 * grid_.spacing_mm) {
            const glm::dvec3 at = to_voxel_coordinates(grid_, place_mm + at_mm / length_mm * way_mm);
            const glm::ivec3 passed(glm::floor(at + 0.5));
            if (structure.contains(passed) && !cavity_.contains(passed)) return std::nullopt;
        }
        return std::max(0.0, length_mm - grid_.spacing_mm);
    }

  private:
    Grid grid_;
    VoxelSet cavity_;
    std::vector<glm::dvec3> surface_mm_;
    NearestPlace nearest_;
    glm::dvec3 low_{0.0};
    glm::dvec3 high_{0.0};
};

/// In faces of a voxel; 0: the voxel is not of the surface. The surface has no face where the grid ends.
double area(const StructureMask& structure, const glm::ivec3& voxel) {
    const auto goes_on = [&](const glm::ivec3& beside) {
        return structure.contains(beside) || !contains(structure.grid(), beside);
    };
    int axes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        glm::ivec3 step(0);
        step[axis] = 1;
        axes += goes_on(voxel + step) && goes_on(voxel - step) ? 0 : 1;
    }
    return std::sqrt(static_cast<double>(axes));
}

ExposureMetrics exposure_of(const Structure& structure, const BareSurface& bare, std::string name) {
    constexpr double nothing_mm = 1e-6;
    ExposureMetrics metrics{.name = std::move(name)};
    const StructureMask& mask = structure.mask;
    const glm::ivec3 size = size_in_bricks(mask.grid());
    double surface = 0.0;
    for (const StructureBrick& brick : mask.bricks()) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size, brick.brick);
        brick.voxels.for_each([&](std::size_t offset) {
            const glm::ivec3 voxel = first + voxel_in_brick(offset);
            const double faces = area(mask, voxel);
            if (faces == 0.0) return;
            surface += faces;
            const auto over_mm = bare.thickness_mm(mask, voxel);
            if (!over_mm) return;
            if (*over_mm < nothing_mm) metrics.bare_share += faces;
            for (std::size_t k = 0; k < thin_mm.size(); ++k)
                if (*over_mm < thin_mm[k] - nothing_mm) metrics.thin_share[k] += faces;
        });
    }
    if (!(surface > 0.0)) return metrics;
    metrics.bare_share /= surface;
    for (double& share : metrics.thin_share) share /= surface;
    return metrics;
}

}  // namespace

std::vector<ExposureMetrics> exposure_metrics(const SessionTrace& trace) {
    std::vector<ExposureMetrics> all;
    if (trace.structure_places.empty()) return all;
    const BareSurface bare(trace);
    for (const Structure& structure : trace.structure_places)
        if (trace.session.tissues[structure.tissue].is_protected && !structure.mask.empty())
            all.push_back(exposure_of(structure, bare, trace.session.tissues[structure.tissue].name));
    return all;
}

namespace {

constexpr double piece_mm = 0.5;
constexpr double least_slope = 1.0 / std::numbers::sqrt2;  // of 45 degrees

class ForceAndFeedSum {
  public:
    void add(const SessionTrace& trace, std::size_t i) {
        const TraceSample& now = trace.samples[i];
        for (const TraceMoment& moment : now.moments) {
            force_s_ += moment.dt_s;
            force_n_s_ += moment.force_n * moment.dt_s;
        }
        if (i == 0 || trace.is_discontinuous(i)) return;
        path_s_ += trace.dt_s(i);
        path_mm_ += glm::length(now.burr_mm - trace.samples[i - 1].burr_mm);
    }
    ForceAndFeed result() const {
        ForceAndFeed all{.time_s = force_s_};
        if (force_s_ > 0.0) all.force_n = force_n_s_ / force_s_;
        if (path_s_ > 0.0) all.feed_mm_per_s = path_mm_ / path_s_;
        return all;
    }

  private:
    double force_s_ = 0.0;
    double force_n_s_ = 0.0;
    double path_s_ = 0.0;
    double path_mm_ = 0.0;
};

/// A piece of a stroke under way.
struct Piece {
    glm::dvec3 from_mm;
    double from_distance_mm;
};

struct Sums {
    std::array<ForceAndFeedSum, near_mm.size()> within{};
    NearStructure directions{};
    std::optional<Piece> piece{};

    void lead(const glm::dvec3& to_mm, double distance_mm) {
        const double length_mm = glm::length(to_mm - piece->from_mm);
        if (length_mm < piece_mm - 1e-6) return;
        const double slope = (piece->from_distance_mm - distance_mm) / length_mm;
        (slope > least_slope    ? directions.toward_mm
         : slope < -least_slope ? directions.away_mm
                                : directions.along_mm) += length_mm;
        piece = Piece{to_mm, distance_mm};
    }
};

/// Nothing: further than `farthest_mm`.
std::optional<double> distance_mm(const TraceSample& sample, std::size_t tissue, double farthest_mm) {
    const auto found = std::ranges::find(sample.distances, tissue, &StructureDistance::tissue);
    if (found == sample.distances.end() || !found->distance_mm || *found->distance_mm > farthest_mm)
        return std::nullopt;
    return found->distance_mm;
}

void add_frame(const SessionTrace& trace, std::size_t i, std::size_t tissue,
               std::map<std::size_t, Sums>& all) {
    const TraceSample& now = trace.samples[i];
    const auto is_at_mm = now.cuts() ? distance_mm(now, tissue, near_mm.back()) : std::nullopt;
    if (!is_at_mm) {
        if (const auto known = all.find(tissue); known != all.end()) known->second.piece.reset();
        return;
    }
    Sums& sums = all[tissue];
    for (std::size_t k = 0; k < near_mm.size(); ++k)
        if (*is_at_mm <= near_mm[k]) sums.within[k].add(trace, i);
    if (i == 0 || trace.is_discontinuous(i)) {
        sums.piece.reset();
        return;
    }
    // The frame's path begins at the frame before, which need not have cut.
    if (const auto was_at_mm = distance_mm(trace.samples[i - 1], tissue, near_mm.back());
        was_at_mm && !sums.piece)
        sums.piece = Piece{trace.samples[i - 1].burr_mm, *was_at_mm};
    if (sums.piece) sums.lead(now.burr_mm, *is_at_mm);
}

}  // namespace

std::optional<double> NearStructure::toward_share() const {
    const double all_mm = toward_mm + along_mm + away_mm;
    return all_mm > 0.0 ? std::optional(toward_mm / all_mm) : std::nullopt;
}

NearnessMetrics nearness_metrics(const SessionTrace& trace) {
    ForceAndFeedSum elsewhere;
    std::map<std::size_t, Sums> all;
    for (std::size_t i = 0; i < trace.samples.size(); ++i) {
        bool is_near = false;
        for (const StructureAccount& account : trace.structures) {
            const std::size_t tissue = account.last.tissue;
            add_frame(trace, i, tissue, all);
            is_near = is_near || distance_mm(trace.samples[i], tissue, near_mm.back());
        }
        if (trace.samples[i].cuts() && !is_near) elsewhere.add(trace, i);
    }
    NearnessMetrics metrics{.elsewhere = elsewhere.result()};
    for (auto& [tissue, sums] : all) {
        NearStructure one = sums.directions;
        one.name = trace.session.tissues[tissue].name;
        for (std::size_t k = 0; k < near_mm.size(); ++k) one.within[k] = sums.within[k].result();
        metrics.structures.push_back(std::move(one));
    }
    return metrics;
}

}  // namespace osteomill
