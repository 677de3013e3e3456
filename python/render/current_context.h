// A context that is current for a while: the next drawing may be on another thread.
#pragma once

#include "render_client/volume/gl/offscreen_context.h"

namespace osteomill::python {

class CurrentContext {
  public:
    explicit CurrentContext(const gl::OffscreenContext& context) : context_(context) {
        context_.make_current();
    }
    ~CurrentContext() { context_.release(); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

  private:
    const gl::OffscreenContext& context_;
};

}  // namespace osteomill::python
