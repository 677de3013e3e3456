// Silence of OpenAL and ALSA on standard error: about a sound card that is not there they have ten lines, and
// the program has one.
#pragma once

namespace osteomill {

/// Before the program has threads: it sets a variable of the environment (ALSOFT_LOGLEVEL, unless it is set).
void quiet_sound_libraries();

}  // namespace osteomill
