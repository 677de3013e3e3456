// A condition of a rating: comparisons of named quantities, joined by and, or and not. It is read, not run:
// nothing in it can do anything but compare numbers.
//
//     condition   any                     any         all { "or" all }
//     all         not { "and" not }       not         "not" not | comparison
//     comparison  sum [ ("<" | "<=" | ">" | ">=" | "==" | "!=") sum ]
//     sum         product { ("+" | "-") product }
//     product     factor { ("*" | "/") factor }
//     factor      "-" factor | number | quantity | "(" any ")"
//     quantity    key [ "(" 'name' ")" ]  key of rating_quantities.h; a name in single or double quotes
//
// A quantity has a range: one number if it was measured, more if only a bound is known, all numbers if
// nothing is. A comparison of ranges is decided if all their numbers agree, else it is unknown. And, or, not
// follow Kleene's logic: a result that does not depend on the unknown is decided. Arithmetic is that of
// intervals.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace osteomill {

/// One printable line: what is wrong, at which letter, and what would be right.
class ConditionError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// All numbers from low to high.
struct ValueRange {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    static ValueRange of(double value) { return {value, value}; }
};

struct AskedQuantity {
    std::string key{};
    std::string of{};  ///< empty: no name

    bool operator==(const AskedQuantity&) const = default;
};

/// A sign, a word, a number or a quantity of a condition.
struct ConditionPiece {
    enum class Kind : std::uint8_t {
        word,         ///< "and", "or", "not"
        comparison,   ///< "<", "<=", ">", ">=", "==", "!="
        operation,    ///< "+", "-", "*", "/"
        parenthesis,  ///< "(", ")", but for those around a quantity's name
        number,
        quantity,
    };
    Kind kind;
    std::string text{};  ///< of the first four
    double number = 0.0;
    AskedQuantity quantity{};
};

class RatingCondition {
  public:
    /// Parentheses, not and - within one another.
    static constexpr int deepest = 16;

    /// Throws ConditionError, also for more than longest_rating_condition bytes, and for unknown keys.
    explicit RatingCondition(std::string_view text);

    /// Each once, in the order in which they first come.
    const std::vector<AskedQuantity>& quantities() const { return quantities_; }

    /// In the order of the text, for a display of the condition.
    const std::vector<ConditionPiece>& pieces() const { return pieces_; }

    /// Whether it holds; nothing: unknown. `value_of` is asked once for each quantity.
    std::optional<bool> holds(const std::function<ValueRange(const AskedQuantity&)>& value_of) const;

  private:
    friend class ConditionParser;
    enum class Op : std::uint8_t {
        number,
        quantity,
        negate,
        add,
        subtract,
        multiply,
        divide,
        less,
        at_most,
        more,
        at_least,
        equal,
        unequal,
        both,
        either,
        opposite,
    };
    struct Step {
        Op op;
        double number = 0.0;
        std::size_t quantity = 0;
    };

    std::vector<Step> steps_;  // a value, or an operation on those before it (reverse Polish)
    std::vector<AskedQuantity> quantities_;
    std::vector<ConditionPiece> pieces_;
};

/// Parser of a rating's condition (rating_condition.h): recursive descent, as deep as
/// RatingCondition::deepest.
class ConditionParser {
  public:
    ConditionParser(std::string_view text, RatingCondition& condition) : text_(text), condition_(condition) {}
    /// Once. Throws ConditionError.
    void run();

  private:
    using Op = RatingCondition::Op;
    using Piece = ConditionPiece::Kind;
    enum class Kind : std::uint8_t { number, truth };
    /// Counts one thing within another as long as it lives.
    struct Depth;

    Kind any();
    Kind all();
    Kind opposite();
    Kind comparison();
    Kind sum();
    Kind product();
    Kind factor();
    Kind quantity(std::string_view key);
    std::string name();

    void skip_blanks();
    /// Takes a sign or a word, if it is the next.
    bool take(std::string_view sign);
    bool take_word(std::string_view word);
    /// The same, and it is a piece of the condition.
    bool take_piece(Piece kind, const char* text);
    std::string_view word_here() const;
    void push(Op op) { condition_.steps_.push_back({op}); }
    void require(Kind is, Kind wanted, const char* by) const;
    [[noreturn]] void fail(const std::string& what) const;

    std::string_view text_;
    RatingCondition& condition_;
    std::size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace osteomill
