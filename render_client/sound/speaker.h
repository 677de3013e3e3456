// The loudspeaker: plays the sound of a burr through OpenAL, on a thread of its own that sleeps while there
// is nothing to hear. It plays some 60 ms behind the newest cue.
#pragma once

#include <AL/al.h>
#include <AL/alc.h>

#include <array>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "common/sound/burr_sound.h"
#include "common/sound/warning_tone.h"

namespace osteomill {

/// One line on why nothing can be heard.
class NoSound : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class Speaker {
  public:
    /// Opens the system's default output. Throws NoSound. One at a time in a program: OpenAL has one current
    /// context.
    Speaker();
    ~Speaker();
    Speaker(const Speaker&) = delete;
    Speaker& operator=(const Speaker&) = delete;

    /// OpenAL's name for it.
    const std::string& device_name() const { return device_name_; }

    // Any thread; none of these waits for the device.
    /// From now on it sounds like this.
    void hear(const SoundCue& cue, StructureWarning warning);
    /// Whether the device has gone, pulled out for instance: nothing is heard any more.
    bool has_lost_device() const;

  private:
    struct ClosingDevice {
        void operator()(ALCdevice* device) const { alcCloseDevice(device); }
    };
    struct LeavingContext {
        void operator()(ALCcontext* context) const {
            alcMakeContextCurrent(nullptr);
            alcDestroyContext(context);
        }
    };
    static constexpr std::size_t buffers = 4;
    static constexpr std::size_t samples_a_buffer = 720;

    void play();
    /// Gives a buffer the next samples, and puts it last in the queue.
    void fill(ALuint buffer);
    void fill_what_was_played();
    /// Until somebody wants to hear something; false: until the end.
    bool wait_for_sound();
    void take_cue();

    std::unique_ptr<ALCdevice, ClosingDevice> device_;
    std::unique_ptr<ALCcontext, LeavingContext> context_;
    std::string device_name_;
    bool tells_of_loss_ = false;

    // The thread's.
    ALuint source_ = 0;
    std::array<ALuint, buffers> buffers_{};
    BurrSound sound_;
    WarningTone tone_;

    mutable std::mutex mutex_;
    std::condition_variable woken_;
    std::optional<SoundCue> newest_;                     // not yet taken
    StructureWarning warning_ = StructureWarning::none;  // that came with it
    bool is_over_ = false;
    bool has_lost_device_ = false;
    std::thread thread_;
};

// Keeps OpenAL and ALSA silent on standard error: they write ten lines about a missing sound card, the
// program writes one.

/// Before the program has threads: it sets a variable of the environment (ALSOFT_LOGLEVEL, unless it is set).
void quiet_sound_libraries();

}  // namespace osteomill
