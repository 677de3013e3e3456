// Reason why something that came over the wire was refused: one line for people, fit for a log.
#pragma once

#include <string>

namespace osteomill {

struct WireError {
    std::string line{};
};

}  // namespace osteomill
