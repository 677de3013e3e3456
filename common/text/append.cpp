#include "common/text/append.h"

#include <iterator>

namespace osteomill {

void append_values(std::string& text, fmt::string_view format, fmt::format_args values) {
    fmt::vformat_to(std::back_inserter(text), format, values);
}

void append_values(fmt::memory_buffer& text, fmt::string_view format, fmt::format_args values) {
    fmt::vformat_to(std::back_inserter(text), format, values);
}

}  // namespace osteomill
