#include "common/scene/rating_condition.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "common/scene/condition_parser.h"

namespace osteomill {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A result that is no number, as infinity less infinity, gives no bound.
ValueRange range_of(std::initializer_list<double> ends) {
    ValueRange range{infinity, -infinity};
    for (const double end : ends) {
        if (std::isnan(end)) return {};
        range = {std::min(range.low, end), std::max(range.high, end)};
    }
    return range;
}

ValueRange product(const ValueRange& a, const ValueRange& b) {
    // 0 times anything is 0.
    const auto times = [](double x, double y) { return x == 0.0 || y == 0.0 ? 0.0 : x * y; };
    return range_of({times(a.low, b.low), times(a.low, b.high), times(a.high, b.low), times(a.high, b.high)});
}

ValueRange quotient(const ValueRange& a, const ValueRange& b) {
    if (b.low <= 0.0 && b.high >= 0.0) return {};
    return range_of({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

std::optional<bool> is_less(const ValueRange& a, const ValueRange& b) {
    if (a.high < b.low) return true;
    return a.low >= b.high ? std::optional(false) : std::nullopt;
}

std::optional<bool> is_equal(const ValueRange& a, const ValueRange& b) {
    if (a.high < b.low || b.high < a.low) return false;
    return a.low == a.high && b.low == b.high ? std::optional(true) : std::nullopt;
}

std::optional<bool> opposite_of(const std::optional<bool>& a) {
    return a ? std::optional(!*a) : std::nullopt;
}

std::optional<bool> either_of(const std::optional<bool>& a, const std::optional<bool>& b) {
    if (a == true || b == true) return true;
    return a && b ? std::optional(false) : std::nullopt;
}

/// A number or a truth; the parser has checked which.
struct Result {
    ValueRange number{};
    std::optional<bool> truth{};
};

}  // namespace

RatingCondition::RatingCondition(std::string_view text) {
    ConditionParser(text, *this).run();
}

std::optional<bool> RatingCondition::holds(
    const std::function<ValueRange(const AskedQuantity&)>& value_of) const {
    std::vector<ValueRange> values;
    for (const AskedQuantity& asked : quantities_) {
        const ValueRange value = value_of(asked);
        values.push_back(value.low <= value.high ? value : ValueRange{});
    }
    std::vector<Result> stack;
    for (const Step& step : steps_) {
        Result b;
        Result a;
        if (step.op >= Op::add && step.op != Op::opposite) {
            b = stack.back();
            stack.pop_back();
        }
        if (step.op >= Op::negate) {
            a = stack.back();
            stack.pop_back();
        }
        const ValueRange &x = a.number, &y = b.number;
        switch (step.op) {
            case Op::number:
                stack.push_back({.number = ValueRange::of(step.number)});
                break;
            case Op::quantity:
                stack.push_back({.number = values[step.quantity]});
                break;
            case Op::negate:
                stack.push_back({.number = {-x.high, -x.low}});
                break;
            case Op::add:
                stack.push_back({.number = range_of({x.low + y.low, x.high + y.high})});
                break;
            case Op::subtract:
                stack.push_back({.number = range_of({x.low - y.high, x.high - y.low})});
                break;
            case Op::multiply:
                stack.push_back({.number = product(x, y)});
                break;
            case Op::divide:
                stack.push_back({.number = quotient(x, y)});
                break;
            case Op::less:
                stack.push_back({.truth = is_less(x, y)});
                break;
            case Op::at_most:
                stack.push_back({.truth = opposite_of(is_less(y, x))});
                break;
            case Op::more:
                stack.push_back({.truth = is_less(y, x)});
                break;
            case Op::at_least:
                stack.push_back({.truth = opposite_of(is_less(x, y))});
                break;
            case Op::equal:
                stack.push_back({.truth = is_equal(x, y)});
                break;
            case Op::unequal:
                stack.push_back({.truth = opposite_of(is_equal(x, y))});
                break;
            case Op::both:
                stack.push_back(
                    {.truth = opposite_of(either_of(opposite_of(a.truth), opposite_of(b.truth)))});
                break;
            case Op::either:
                stack.push_back({.truth = either_of(a.truth, b.truth)});
                break;
            case Op::opposite:
                stack.push_back({.truth = opposite_of(a.truth)});
                break;
        }
    }
    return stack.back().truth;
}

}  // namespace osteomill
