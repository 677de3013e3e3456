// Reports of how far a long piece of work has come.
#pragma once

#include <functional>

namespace osteomill::study {

/// Called with how much is done, 0 to 1, ascending.
using Progress = std::function<void(double done)>;

}  // namespace osteomill::study
