// Parser of a rating's condition (rating_condition.h): recursive descent, as deep as
// RatingCondition::deepest.
#pragma once

#include <string_view>

#include "common/scene/rating_condition.h"

namespace osteomill {

class ConditionParser {
  public:
    ConditionParser(std::string_view text, RatingCondition& condition) : text_(text), condition_(condition) {}
    /// Once. Throws ConditionError.
    void run();

  private:
    using Op = RatingCondition::Op;
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
