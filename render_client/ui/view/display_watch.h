// A watch for an X server that goes. Xlib's own answer is to end the program on the spot, without a report.
#pragma once

#include <atomic>

namespace osteomill {

/// From now on *is_gone becomes true, on whichever thread speaks to the display, when the display of GLFW's
/// windows goes; what is drawn then is lost without harm. Does nothing where GLFW shows its windows otherwise
/// than through X11. Call after glfwInit; `is_gone` must live until glfwTerminate.
void watch_display(std::atomic<bool>* is_gone);

}  // namespace osteomill
