// Writer of text to a descriptor (a file, a pipe or a terminal) on a thread of its own.
#pragma once

#include <cstddef>
#include <string>

#include "common/files/background_writer.h"

namespace osteomill {

/// A descriptor that fails is given up for good: later text is dropped.
class TextWriter final : public BackgroundWriter<std::string> {
  public:
    /// Writes to a duplicate of `descriptor`, so that it is the caller's to close or to redirect. A closed
    /// descriptor counts as a failed one.
    TextWriter(int descriptor, std::size_t capacity_bytes);
};

}  // namespace osteomill
