#include "analysis/report/condition_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "common/scene/rating_condition.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

using Words = std::pair<std::string_view, const char*>;

/// By key; those of nearness are below.
constexpr std::array quantity_words{
    Words{"time_s", "time"},
    Words{"paused_s", "time paused"},
    Words{"idle_s", "time idle"},
    Words{"spindle_s", "time with the spindle on"},
    Words{"cutting_s", "time of cutting"},
    Words{"path_mm", "path of the hand"},
    Words{"smoothness_ldlj", "smoothness of the path"},
    Words{"strokes", "strokes"},
    Words{"strokes_undone", "strokes that were undone"},
    Words{"stroke_duration_mean_s", "mean duration of a stroke"},
    Words{"stroke_duration_max_s", "longest stroke"},
    Words{"stroke_length_mean_mm", "mean length of a stroke"},
    Words{"stroke_smoothness_ldlj", "smoothness of strokes"},
    Words{"stroke_reaches_per_s", "reaches in strokes"},
    Words{"stroke_length_variation", "variation of strokes' length"},
    Words{"stroke_force_variation", "variation of strokes' force"},
    Words{"cutting_speed_mean_mm_per_s", "mean speed of cutting"},
    Words{"cutting_speed_p95_mm_per_s", "95th percentile of the speed of cutting"},
    Words{"depth_max_mm", "greatest depth"},
    Words{"cutting_depth_mean_mm", "mean depth of cutting"},
    Words{"cutting_angle_mean_deg", "angle of spindle to surface"},
    Words{"burr_in_view_share", "cut with the burr in view"},
    Words{"removed_mm3", "bone removed"},
    Words{"undone_mm3", "given back by undo"},
    Words{"undos", "number of undos"},
    Words{"peak_force_n", "peak force"},
    Words{"force_mean_n", "mean force"},
    Words{"force_p95_n", "95th percentile of the force"},
    Words{"force_impulse_n_s", "impulse"},
    Words{"force_time_s", "time of cutting"},
    Words{"removed_of_tissue_mm3", "removed"},
    Words{"removed_by_burr_mm3", "removed"},
    Words{"burr_cutting_s", "time of cutting"},
    Words{"burr_force_mean_n", "mean force"},
    Words{"breakthroughs", "number of breakthroughs"},
    Words{"plunge_mean_mm", "mean plunge in 100 ms"},
    Words{"plunge_max_mm", "deepest plunge in 100 ms"},
    Words{"elsewhere_cutting_s", "time of cutting further than 3 mm from protected structures"},
    Words{"elsewhere_force_n", "mean force further than 3 mm from protected structures"},
    Words{"elsewhere_feed_mm_per_s", "mean feed further than 3 mm from protected structures"},
    Words{"structure_nearest_mm", "nearest approach"},
    Words{"structure_touches", "touches"},
    Words{"structure_first_touch_s", "time of the first touch"},
    Words{"structure_touched_s", "time of touching"},
    Words{"structure_dose_mm3", "removed"},
    Words{"structure_undone_mm3", "milled and undone"},
    Words{"structure_entered_mm3", "entered by the burr"},
    Words{"structure_bare_share", "surface laid bare"},
    Words{"structure_under_0_5_mm_share", "surface under less than 0.5 mm"},
    Words{"structure_under_1_mm_share", "surface under less than 1 mm"},
    Words{"structure_under_2_mm_share", "surface under less than 2 mm"},
    Words{"structure_toward_mm", "way of strokes toward it"},
    Words{"structure_along_mm", "way of strokes along it"},
    Words{"structure_away_mm", "way of strokes away from it"},
    Words{"structure_toward_share", "share of strokes toward it"},
    Words{"plan_mm3", "volume of the plan"},
    Words{"plan_removed_mm3", "removed of the plan"},
    Words{"plan_removed_share", "share of the plan removed"},
    Words{"plan_outside_mm3", "removed outside the plan"},
    Words{"plan_margin_mm", "margin of the plan"},
    Words{"plan_excess_mm3", "removed beyond the margin"},
    Words{"plan_surface_mean_mm", "mean surface distance"},
    Words{"plan_surface_p95_mm", "95th percentile of the surface distance"},
    Words{"plan_hausdorff_mm", "largest surface distance"},
    Words{"region_mm3", "bone of the region"},
    Words{"region_removed_mm3", "removed of the region"},
    Words{"region_removed_share", "share of the region removed"},
};

constexpr std::string_view near_key = "structure_near_";

/// Behind "structure_near_K_mm_".
constexpr std::array near_words{
    Words{"cutting_s", "time of cutting within {} mm"},
    Words{"force_n", "mean force within {} mm"},
    Words{"force_ratio", "force within {} mm by that elsewhere"},
    Words{"feed_mm_per_s", "mean feed within {} mm"},
    Words{"feed_ratio", "feed within {} mm by that elsewhere"},
};

/// By the end of a key; the longest comes first.
constexpr std::array unit_by_end{
    Words{"_mm_per_s", "mm/s"}, Words{"_per_s", "1/s"}, Words{"_n_s", "N s"}, Words{"_mm3", "mm³"},
    Words{"_mm", "mm"},         Words{"_deg", "°"},     Words{"_s", "s"},     Words{"_n", "N"},
};

/// Longer signs come first.
constexpr std::array sign_words{
    Words{"<=", "≤"}, Words{">=", "≥"}, Words{"==", "="}, Words{"!=", "≠"}, Words{"<", "<"}, Words{">", ">"},
};

std::string words_of_key(std::string_view key) {
    if (const auto found = std::ranges::find(quantity_words, key, &Words::first);
        found != quantity_words.end())
        return tr(std::string(found->second));
    if (!key.starts_with(near_key)) return std::string(key);
    const std::string_view rest = key.substr(near_key.size());
    for (const auto& [end, words] : near_words)
        if (rest.ends_with(end) && rest.size() == end.size() + std::string_view("1_mm_").size())
            return trf(words, rest.substr(0, 1));
    return std::string(key);
}

struct ShownUnit {
    const char* name = "";
    double scale = 1.0;
};

ShownUnit unit_of(std::string_view key) {
    if (key.ends_with("_share")) return {"%", 100.0};
    const auto unit =
        std::ranges::find_if(unit_by_end, [&](const Words& one) { return key.ends_with(one.first); });
    return unit == unit_by_end.end() ? ShownUnit{} : ShownUnit{unit->second};
}

bool is_of_word(char letter) {
    return (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') || letter == '_' ||
           (letter >= '0' && letter <= '9');
}

/// Writes a condition that RatingCondition has read, so that every piece is known.
class ConditionWriter {
  public:
    explicit ConditionWriter(std::string_view rest) : rest_(rest) {}

    std::string written() {
        for (skip_blanks(); !rest_.empty(); skip_blanks()) {
            const char letter = rest_.front();
            if ((letter >= '0' && letter <= '9') || letter == '.')
                write_number();
            else if (is_of_word(letter))
                write_word();
            else
                write_sign();
        }
        return text_;
    }

  private:
    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\n"), rest_.size())); }
    void add(std::string_view piece) {
        const bool is_close = piece == ")" || text_.empty() || text_.ends_with('(');
        text_ += is_close ? "" : " ";
        text_ += piece;
    }
    void write_number() {
        double number = 0.0;
        const char* const end = std::from_chars(rest_.data(), rest_.data() + rest_.size(), number).ptr;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        skip_blanks();
        const bool is_reckoned_with =
            !rest_.empty() && std::string_view("+-*/").find(rest_.front()) != std::string_view::npos;
        const ShownUnit unit = is_compared_ && !is_reckoned_with ? unit_of(compared_) : ShownUnit{};
        add(ShownValue{with_decimal_sign(fmt::format("{:g}", unit.scale * number)), unit.name}.text());
        is_compared_ = false;
    }
    void write_word() {
        const auto size =
            static_cast<std::size_t>(std::ranges::find_if_not(rest_, is_of_word) - rest_.begin());
        const std::string key(rest_.substr(0, size));
        rest_.remove_prefix(size);
        if (key == "and" || key == "or" || key == "not") {
            forget();
            return add(tr(key));
        }
        add(quantity_text(key, name()));
        if (is_alone_) compared_ = key;
        is_alone_ = false;
        is_compared_ = false;
    }
    /// The quoted name in parentheses behind a quantity, if there is one.
    std::string name() {
        skip_blanks();
        if (!rest_.starts_with('(')) return {};
        const std::size_t first = rest_.find_first_of("'\"");
        const std::size_t end = rest_.find(rest_[first], first + 1);
        std::string name(rest_.substr(first + 1, end - first - 1));
        rest_.remove_prefix(rest_.find(')', end) + 1);
        return name;
    }
    void write_sign() {
        const auto sign =
            std::ranges::find_if(sign_words, [&](const Words& one) { return rest_.starts_with(one.first); });
        if (sign != sign_words.end()) {
            rest_.remove_prefix(sign->first.size());
            is_compared_ = !compared_.empty();
            return add(sign->second);
        }
        const char letter = rest_.front();
        rest_.remove_prefix(1);
        if (letter == '*' || letter == '/') compared_.clear();
        is_compared_ = is_compared_ && letter == '-';
        add(letter == '*' ? "·" : std::string_view(&letter, 1));
    }
    void forget() {
        compared_.clear();
        is_alone_ = true;
        is_compared_ = false;
    }

    std::string_view rest_;
    std::string text_;
    std::string compared_;      ///< key of the comparison's first quantity, which gives its unit
    bool is_alone_ = true;      ///< no quantity yet in this comparison
    bool is_compared_ = false;  ///< a number here is what the quantity is compared with
};

}  // namespace

std::string quantity_text(std::string_view key, const std::string& of) {
    return of.empty() ? words_of_key(key) : fmt::format("{} ({})", words_of_key(key), tissue_words(of));
}

ShownValue quantity_value(std::string_view key, double value) {
    const ShownUnit unit = unit_of(key);
    return {number_text(unit.scale * value), unit.name};
}

std::string condition_text(const std::string& condition) {
    try {
        (void)RatingCondition(condition);
    } catch (const ConditionError&) {
        return condition;
    }
    return ConditionWriter(condition).written();
}

}  // namespace osteomill
