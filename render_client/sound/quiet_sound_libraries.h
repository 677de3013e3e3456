// Keeps OpenAL and ALSA silent on standard error: they write ten lines about a missing sound card, the
// program writes one.
#pragma once

namespace osteomill {

/// Before the program has threads: it sets a variable of the environment (ALSOFT_LOGLEVEL, unless it is set).
void quiet_sound_libraries();

}  // namespace osteomill
