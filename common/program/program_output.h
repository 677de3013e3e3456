// Lines of a program on its standard output and standard error while it runs. Neither can hold it up.
#pragma once

#include <unistd.h>

#include <memory>

#include "common/log/line_stream.h"

namespace osteomill {

struct ProgramOutput {
    /// For programs that wait for a line.
    std::shared_ptr<LineStream> out = std::make_shared<LineStream>(STDOUT_FILENO);
    /// For people; the log goes there, too.
    std::shared_ptr<LineStream> err = std::make_shared<LineStream>(STDERR_FILENO);

    /// Last: waits for both for a bounded time. Later output is discarded.
    void finish() const {
        out->finish();
        err->finish();
    }
};

}  // namespace osteomill
