#include "render_client/sound/speaker.h"

#include <alsa/asoundlib.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>

// ALC_EXT_disconnect; the name is missing from OpenAL's own header.
#ifndef ALC_CONNECTED
#define ALC_CONNECTED 0x313
#endif

namespace osteomill {

namespace {

/// A third of a buffer.
constexpr std::chrono::milliseconds look_period(5);
constexpr float full_scale = 32767.0f;

}  // namespace

Speaker::Speaker() : device_(alcOpenDevice(nullptr)) {
    if (!device_) throw NoSound("OpenAL finds no output: connect one, and see that no other program has it");
    context_.reset(alcCreateContext(device_.get(), nullptr));
    if (!context_ || alcMakeContextCurrent(context_.get()) == ALC_FALSE)
        throw NoSound("OpenAL finds an output, and cannot play through it");
    device_name_ = alcGetString(device_.get(), ALC_ALL_DEVICES_SPECIFIER);
    tells_of_loss_ = alcIsExtensionPresent(device_.get(), "ALC_EXT_disconnect") == ALC_TRUE;
    alGenSources(1, &source_);
    alGenBuffers(static_cast<ALsizei>(buffers), buffers_.data());
    // The burr is where the listener is, however loud the others are.
    alSourcei(source_, AL_SOURCE_RELATIVE, AL_TRUE);
    if (alGetError() != AL_NO_ERROR) throw NoSound("OpenAL has no source of sound left");
    thread_ = std::thread([this] { play(); });
}

Speaker::~Speaker() {
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    woken_.notify_all();
    thread_.join();
    alSourceStop(source_);
    alDeleteSources(1, &source_);
    alDeleteBuffers(static_cast<ALsizei>(buffers), buffers_.data());
}

void Speaker::hear(const SoundCue& cue, StructureWarning warning) {
    {
        const std::lock_guard lock(mutex_);
        newest_ = cue;
        warning_ = warning;
    }
    woken_.notify_all();
}

bool Speaker::has_lost_device() const {
    const std::lock_guard lock(mutex_);
    return has_lost_device_;
}

void Speaker::take_cue() {
    const std::lock_guard lock(mutex_);
    const auto cue = std::exchange(newest_, std::nullopt);
    if (!cue) return;
    sound_.hear(*cue);
    tone_.warn(warning_);
}

bool Speaker::wait_for_sound() {
    std::unique_lock lock(mutex_);
    woken_.wait(lock, [this] {
        return is_over_ || (newest_ && (newest_->rev_per_s > 0.0 || warning_ != StructureWarning::none));
    });
    return !is_over_;
}

void Speaker::fill(ALuint buffer) {
    take_cue();
    std::array<float, samples_a_buffer> samples;
    sound_.render(samples);
    tone_.add_to(samples);
    std::array<std::int16_t, samples_a_buffer> levels;
    for (std::size_t i = 0; i < samples.size(); ++i)
        levels[i] = static_cast<std::int16_t>(std::lround(full_scale * samples[i]));
    alBufferData(buffer, AL_FORMAT_MONO16, levels.data(), sizeof levels, BurrSound::rate_hz);
    alSourceQueueBuffers(source_, 1, &buffer);
}

void Speaker::fill_what_was_played() {
    ALint played = 0;
    alGetSourcei(source_, AL_BUFFERS_PROCESSED, &played);
    for (; played > 0; --played) {
        ALuint buffer = 0;
        alSourceUnqueueBuffers(source_, 1, &buffer);
        fill(buffer);
    }
    // It stops by itself if a busy machine let the queue run dry.
    ALint state = 0;
    alGetSourcei(source_, AL_SOURCE_STATE, &state);
    if (state != AL_PLAYING) alSourcePlay(source_);
}

void Speaker::play() {
    while (wait_for_sound()) {
        for (const ALuint buffer : buffers_) fill(buffer);
        alSourcePlay(source_);
        while (!sound_.is_silent() || !tone_.is_silent()) {
            fill_what_was_played();
            ALCint is_connected = ALC_TRUE;
            if (tells_of_loss_) alcGetIntegerv(device_.get(), ALC_CONNECTED, 1, &is_connected);
            std::unique_lock lock(mutex_);
            has_lost_device_ = is_connected == ALC_FALSE;
            if (has_lost_device_) return;
            if (woken_.wait_for(lock, look_period, [this] { return is_over_; })) return;
        }
        alSourceStop(source_);
        alSourcei(source_, AL_BUFFER, 0);
    }
}

namespace {

void say_nothing(const char*, int, const char*, int, const char*, ...) {}

}  // namespace

void quiet_sound_libraries() {
    setenv("ALSOFT_LOGLEVEL", "0", 0);
    snd_lib_error_set_handler(say_nothing);
}

}  // namespace osteomill
