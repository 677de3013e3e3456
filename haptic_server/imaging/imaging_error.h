// What imaging throws: one line that names the file (or folder), the reason and, where there is one, the
// remedy.
#pragma once

#include <stdexcept>

namespace osteomill {

class ImagingError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace osteomill
