// The thread that draws a window, and the window's OpenGL context on it.
#pragma once

#include <atomic>
#include <exception>
#include <thread>
#include <utility>

#include "render_client/ui/view/window.h"

namespace osteomill {

/// Has the window's context on this thread, whatever happens to the drawing.
class CurrentContext {
  public:
    explicit CurrentContext(Window& window) : window_(window) { window_.make_context_current(); }
    ~CurrentContext() { window_.release_context(); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

  private:
    Window& window_;
};

/// Runs `draw` on a thread of its own; whatever becomes of the caller, it ends that thread first.
class DrawingThread {
  public:
    template <typename Draw>
    DrawingThread(std::atomic<bool>& is_over, Draw&& draw) : is_over_(is_over) {
        thread_ = std::thread([this, draw = std::forward<Draw>(draw)] {
            try {
                draw();
            } catch (...) {
                failure_ = std::current_exception();
            }
            is_over_ = true;
        });
    }
    ~DrawingThread() { end(); }
    DrawingThread(const DrawingThread&) = delete;
    DrawingThread& operator=(const DrawingThread&) = delete;

    /// Throws the exception of `draw`.
    void finish() {
        end();
        if (failure_) std::rethrow_exception(failure_);
    }

  private:
    void end() {
        is_over_ = true;
        if (thread_.joinable()) thread_.join();
    }

    std::atomic<bool>& is_over_;
    std::exception_ptr failure_;
    std::thread thread_;
};

}  // namespace osteomill
