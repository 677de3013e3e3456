#include "common/text/pattern.h"

#include <regex>

namespace osteomill {

struct Pattern::Compiled {
    std::regex expression;
};

Pattern::Pattern(const std::string& expression)
    : compiled_(std::make_unique<const Compiled>(Compiled{std::regex(expression)})) {}

Pattern::~Pattern() = default;

bool Pattern::takes(const std::string& text) const {
    return std::regex_match(text, compiled_->expression);
}

std::vector<std::string> Pattern::first_in(const std::string& text) const {
    std::smatch found;
    if (!std::regex_search(text, found, compiled_->expression)) return {};
    return {found.begin(), found.end()};
}

}  // namespace osteomill
