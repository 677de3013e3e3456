// Regular expressions (ECMAScript's, by std::regex) for short texts. Sources of other libraries do not see
// std::regex, which takes the compiler 3 s in every object.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace osteomill {

class Pattern {
  public:
    /// Throws std::regex_error, a std::runtime_error, if it is no expression.
    explicit Pattern(const std::string& expression);
    ~Pattern();
    Pattern(const Pattern&) = delete;
    Pattern& operator=(const Pattern&) = delete;

    /// Whether it takes all of the text.
    bool takes(const std::string& text) const;
    /// The first part of the text that it takes, then the part of each of its groups, "" of one that took
    /// none; nothing if it takes no part.
    std::vector<std::string> first_in(const std::string& text) const;

  private:
    struct Compiled;
    std::unique_ptr<const Compiled> compiled_;
};

}  // namespace osteomill
