#include "analysis/report/rating_result.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/report/planned_region.h"
#include "analysis/report/session_metrics.h"
#include "common/scene/rating_condition.h"
#include "common/scene/rating_quantities.h"
#include "common/session/structure_distance.h"

namespace osteomill {

namespace {

RegionVolumes volumes_of(const SessionTrace& trace, const PlanRegion& region) {
    SessionInfo session{.tissues = trace.session.tissues, .plan = Plan{.region = region}};
    std::int64_t bone = 0;
    std::int64_t removed = 0;
    const PlannedRegion planned(trace.at_start, session);
    planned.voxels().for_each([&](std::int32_t slot, std::size_t offset, const glm::ivec3&) {
        const int before = trace.at_start.fractions(slot)[offset];
        bone += before;
        removed += before - trace.at_end.fractions(slot)[offset];
    });
    return {trace.mm3(bone), trace.mm3(removed)};
}

/// The known values of the quantities that one item asks for.
class Answers {
  public:
    Answers(std::span<const MetricRow> rows, const std::optional<RegionVolumes>& region,
            std::span<const Tissue> tissues)
        : rows_(rows), region_(region), tissues_(tissues) {}

    std::optional<double> measured(const AskedQuantity& asked) const {
        const RatedQuantity& known = *rated_quantity(asked.key);
        if (known.of == RatedThing::region) return of_region(asked.key);
        std::optional<double> sum;
        for (const MetricRow& row : rows_) {
            const bool is_meant = asked.of.empty() ? adds_up(known.of) || row.of.empty() : row.of == asked.of;
            if (row.key == asked.key && is_meant && row.value) sum = sum.value_or(0.0) + *row.value;
        }
        return sum || !known.is_zero_if_absent ? sum : std::optional(0.0);
    }
    ValueRange range(const AskedQuantity& asked) const {
        if (const auto value = measured(asked)) return ValueRange::of(*value);
        const auto tissue = std::ranges::find(tissues_, asked.of, &Tissue::name);
        if (asked.key != "structure_nearest_mm" || !has_row(asked) || tissue == tissues_.end()) return {};
        return {.low = std::nextafter(watched_mm(*tissue), std::numeric_limits<double>::infinity())};
    }

  private:
    static bool adds_up(RatedThing of) { return of == RatedThing::any_structure || of == RatedThing::burr; }
    bool has_row(const AskedQuantity& asked) const {
        return std::ranges::any_of(
            rows_, [&](const MetricRow& row) { return row.key == asked.key && row.of == asked.of; });
    }
    std::optional<double> of_region(const std::string& key) const {
        if (!region_) return std::nullopt;
        if (key == "region_mm3") return region_->bone_mm3;
        if (key == "region_removed_mm3") return region_->removed_mm3;
        return region_->bone_mm3 > 0.0 ? std::optional(region_->removed_mm3 / region_->bone_mm3)
                                       : std::nullopt;
    }

    std::span<const MetricRow> rows_;
    const std::optional<RegionVolumes>& region_;
    std::span<const Tissue> tissues_;
};

RatedItem rated(const RatingItem& item, const Answers& answers) {
    RatedItem result{.item = item};
    try {
        const RatingCondition condition(item.when);
        for (const AskedQuantity& asked : condition.quantities())
            result.values.push_back({.text = asked.of.empty() ? asked.key : asked.key + " of " + asked.of,
                                     .key = asked.key,
                                     .of = asked.of,
                                     .value = answers.measured(asked)});
        result.is_reached = condition.holds([&](const AskedQuantity& asked) { return answers.range(asked); });
    } catch (const ConditionError& error) {
        result.why_not = error.what();
    }
    return result;
}

}  // namespace

std::vector<std::optional<RegionVolumes>> rated_regions(const SessionTrace& trace) {
    std::vector<std::optional<RegionVolumes>> all;
    for (const RatingItem& item : trace.session.rating)
        all.push_back(item.region ? std::optional(volumes_of(trace, *item.region)) : std::nullopt);
    return all;
}

double RatingResult::points() const {
    double sum = 0.0;
    for (const RatedItem& one : items) sum += one.points();
    return sum;
}

double RatingResult::most_points() const {
    double sum = 0.0;
    for (const RatedItem& one : items) sum += one.item.points;
    return sum;
}

RatingResult rating_result(const Rating& rating, std::span<const MetricRow> rows,
                           std::span<const std::optional<RegionVolumes>> regions,
                           std::span<const Tissue> tissues) {
    RatingResult result;
    for (std::size_t i = 0; i < rating.size(); ++i)
        result.items.push_back(rated(rating[i], Answers(rows, regions[i], tissues)));
    result.undos = static_cast<std::size_t>(sum_of(rows, "undos").value_or(0.0));
    result.undone_mm3 = sum_of(rows, "undone_mm3").value_or(0.0);
    return result;
}

}  // namespace osteomill
