#include "render_client/ui/view/display_watch.h"

#include <X11/Xlib.h>
#include <dlfcn.h>

namespace osteomill {

void watch_display(std::atomic<bool>* is_gone) {
    // A GLFW for Wayland has no such function; calling it by name would end the program there.
    const auto display_of_glfw = reinterpret_cast<Display* (*)()>(::dlsym(RTLD_DEFAULT, "glfwGetX11Display"));
    Display* display = display_of_glfw ? display_of_glfw() : nullptr;
    if (!display) return;
    XSetIOErrorExitHandler(
        display,
        [](Display* lost, void* gone) {
            *static_cast<std::atomic<bool>*>(gone) = true;
            // Xlib has locked it for good, for a program that ends here: another thread that speaks to the
            // display would wait for ever.
            XUnlockDisplay(lost);
        },
        is_gone);
    XSetIOErrorHandler([](Display*) { return 0; });
}

}  // namespace osteomill
