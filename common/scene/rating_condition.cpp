#include "common/scene/rating_condition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "common/scene/nearest_name.h"
#include "common/scene/rating.h"
#include "common/scene/rating_quantities.h"
#include "common/text/foreign_text.h"

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

namespace {

bool begins_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

}  // namespace

struct ConditionParser::Depth {
    explicit Depth(ConditionParser& parser) : parser_(parser) {
        if (++parser.depth_ > RatingCondition::deepest)
            parser.fail(fmt::format("is more than {} deep within itself", RatingCondition::deepest));
    }
    ~Depth() { --parser_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

    ConditionParser& parser_;
};

void ConditionParser::run() {
    if (text_.size() > longest_rating_condition)
        throw ConditionError(
            fmt::format("has {} letters; at most {} are read", text_.size(), longest_rating_condition));
    require(any(), Kind::truth, "a condition");
    skip_blanks();
    if (at_ < text_.size()) fail("ends before it: put 'and' or 'or' between two comparisons");
}

ConditionParser::Kind ConditionParser::any() {
    Kind kind = all();
    while (take_piece(Piece::word, "or")) {
        require(kind, Kind::truth, "'or'");
        require(all(), Kind::truth, "'or'");
        push(Op::either);
        kind = Kind::truth;
    }
    return kind;
}

ConditionParser::Kind ConditionParser::all() {
    Kind kind = opposite();
    while (take_piece(Piece::word, "and")) {
        require(kind, Kind::truth, "'and'");
        require(opposite(), Kind::truth, "'and'");
        push(Op::both);
        kind = Kind::truth;
    }
    return kind;
}

ConditionParser::Kind ConditionParser::opposite() {
    if (!take_piece(Piece::word, "not")) return comparison();
    const Depth depth(*this);
    require(opposite(), Kind::truth, "'not'");
    push(Op::opposite);
    return Kind::truth;
}

ConditionParser::Kind ConditionParser::comparison() {
    // Longer signs come first.
    static constexpr std::array<std::pair<const char*, Op>, 6> signs{{{"<=", Op::at_most},
                                                                      {">=", Op::at_least},
                                                                      {"==", Op::equal},
                                                                      {"!=", Op::unequal},
                                                                      {"<", Op::less},
                                                                      {">", Op::more}}};
    const Kind kind = sum();
    const auto sign = std::ranges::find_if(
        signs, [&](const auto& one) { return take_piece(Piece::comparison, one.first); });
    if (sign == signs.end()) {
        if (take("=")) fail("has '='; a comparison is written ==, <, <=, >, >= or !=");
        return kind;
    }
    require(kind, Kind::number, sign->first);
    require(sum(), Kind::number, sign->first);
    push(sign->second);
    for (const auto& [again, op] : signs)
        if (take(again)) fail("compares three things; join two comparisons by 'and'");
    return Kind::truth;
}

ConditionParser::Kind ConditionParser::sum() {
    Kind kind = product();
    for (;;) {
        const bool adds = take_piece(Piece::operation, "+");
        if (!adds && !take_piece(Piece::operation, "-")) return kind;
        require(kind, Kind::number, adds ? "+" : "-");
        require(product(), Kind::number, adds ? "+" : "-");
        push(adds ? Op::add : Op::subtract);
        kind = Kind::number;
    }
}

ConditionParser::Kind ConditionParser::product() {
    Kind kind = factor();
    for (;;) {
        const bool multiplies = take_piece(Piece::operation, "*");
        if (!multiplies && !take_piece(Piece::operation, "/")) return kind;
        require(kind, Kind::number, multiplies ? "*" : "/");
        require(factor(), Kind::number, multiplies ? "*" : "/");
        push(multiplies ? Op::multiply : Op::divide);
        kind = Kind::number;
    }
}

ConditionParser::Kind ConditionParser::factor() {
    const Depth depth(*this);
    if (take_piece(Piece::operation, "-")) {
        require(factor(), Kind::number, "-");
        push(Op::negate);
        return Kind::number;
    }
    if (take_piece(Piece::parenthesis, "(")) {
        const Kind kind = any();
        if (!take_piece(Piece::parenthesis, ")")) fail("misses a ')'");
        return kind;
    }
    skip_blanks();
    if (at_ == text_.size()) fail("ends where a number or a quantity is missing");
    if (is_digit(text_[at_]) || text_[at_] == '.') {
        double number = 0.0;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), number);
        const auto next = static_cast<std::size_t>(end - text_.data());
        if (error != std::errc() || !std::isfinite(number) ||
            (next < text_.size() && (begins_word(text_[next]) || text_[next] == '.')))
            fail("has no number that can be read, such as 0.5");
        at_ = next;
        condition_.steps_.push_back({.op = Op::number, .number = number});
        condition_.pieces_.push_back({.kind = Piece::number, .number = number});
        return Kind::number;
    }
    const std::string_view key = word_here();
    if (key.empty()) fail(fmt::format("has '{}', which means nothing here", printable(text_.substr(at_, 1))));
    if (key == "and" || key == "or" || key == "not") fail("misses a comparison");
    return quantity(key);
}

ConditionParser::Kind ConditionParser::quantity(std::string_view key) {
    if (rated_quantity(key) == nullptr) {
        std::vector<std::string> keys;
        for (const RatedQuantity& one : rated_quantities) keys.emplace_back(one.key);
        const auto meant = nearest_name(key, keys);
        fail(fmt::format("asks for '{}', which is no quantity{}", one_line(key),
                         meant ? "; did you mean '" + *meant + "'?" : "; docs/metrics.md lists them"));
    }
    at_ += key.size();
    AskedQuantity asked{.key = std::string(key)};
    if (take("(")) {
        asked.of = name();
        if (!take(")")) fail("misses a ')' behind a name");
    }
    condition_.pieces_.push_back({.kind = Piece::quantity, .quantity = asked});
    auto known = std::ranges::find(condition_.quantities_, asked);
    if (known == condition_.quantities_.end()) known = condition_.quantities_.insert(known, std::move(asked));
    condition_.steps_.push_back(
        {.op = Op::quantity, .quantity = static_cast<std::size_t>(known - condition_.quantities_.begin())});
    return Kind::number;
}

std::string ConditionParser::name() {
    skip_blanks();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    const std::size_t end =
        quote == '"' || quote == '\'' ? text_.find(quote, at_ + 1) : std::string_view::npos;
    if (end == std::string_view::npos || end == at_ + 1) fail("takes a name in quotes in the parentheses");
    std::string found(text_.substr(at_ + 1, end - at_ - 1));
    at_ = end + 1;
    return found;
}

void ConditionParser::skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
}

bool ConditionParser::take(std::string_view sign) {
    skip_blanks();
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
}

bool ConditionParser::take_word(std::string_view word) {
    skip_blanks();
    if (word_here() != word) return false;
    at_ += word.size();
    return true;
}

bool ConditionParser::take_piece(Piece kind, const char* text) {
    if (!(kind == Piece::word ? take_word(text) : take(text))) return false;
    condition_.pieces_.push_back({.kind = kind, .text = text});
    return true;
}

std::string_view ConditionParser::word_here() const {
    if (at_ == text_.size() || !begins_word(text_[at_])) return {};
    std::size_t end = at_;
    while (end < text_.size() && (begins_word(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(at_, end - at_);
}

void ConditionParser::require(Kind is, Kind wanted, const char* by) const {
    if (is == wanted) return;
    fail(wanted == Kind::truth
             ? fmt::format("gives {} a number; a comparison belongs there, such as x < 1", by)
             : fmt::format("gives {} a comparison; a number belongs there", by));
}

void ConditionParser::fail(const std::string& what) const {
    throw ConditionError(fmt::format("{} (letter {})", what, std::min(at_, text_.size()) + 1));
}

}  // namespace osteomill
