#include "render_client/sound/quiet_sound_libraries.h"

#include <alsa/asoundlib.h>

#include <cstdlib>

namespace osteomill {

namespace {

void say_nothing(const char*, int, const char*, int, const char*, ...) {}

}  // namespace

void quiet_sound_libraries() {
    setenv("ALSOFT_LOGLEVEL", "0", 0);
    snd_lib_error_set_handler(say_nothing);
}

}  // namespace osteomill
