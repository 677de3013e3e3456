#include "analysis/replay/recording_sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace osteomill {

RecordingSound::RecordingSound(const std::filesystem::path& file) : file_(file) {
    SF_INFO format{};
    format.samplerate = BurrSound::rate_hz;
    format.channels = 1;
    format.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    out_.reset(sf_open(file_.part().c_str(), SFM_WRITE, &format));
    if (!out_) fail(sf_strerror(nullptr));
}

void RecordingSound::add(const Playhead& playhead) {
    const ToolState& state = *playhead.tool();
    // Ticks tell when within the frame the spindle was switched; only states tell the bone that it cuts.
    for (const TickSample& tick : playhead.ticks()) {
        if (tick.spindle_on == heard_.spindle_on && tick.burr == heard_.burr) continue;
        ToolState then = heard_;
        then.spindle_on = tick.spindle_on;
        then.burr = tick.burr;
        if (!then.spindle_on) then.cut.reset();
        render_until(playhead.time_s() - state.time_s + tick.time_s);
        hear(then, playhead);
    }
    render_until(playhead.time_s());
    hear(state, playhead);
}

void RecordingSound::hear(const ToolState& tool, const Playhead& playhead) {
    sound_.hear(cue_of(tool, playhead.session().burrs[tool.burr]));
    heard_ = tool;
}

void RecordingSound::render_until(double time_s) {
    if (!(time_s <= longest_s))
        fail(fmt::format("the recording goes on for more than {:.0f} hours, and a WAV file holds no more",
                         longest_s / 3600.0));
    const auto wanted = static_cast<std::int64_t>(std::llround(time_s * BurrSound::rate_hz));
    std::array<float, 4096> samples;
    while (written_ < wanted) {
        const auto count = std::min<std::int64_t>(wanted - written_, samples.size());
        sound_.render(std::span(samples).first(static_cast<std::size_t>(count)));
        if (sf_write_float(out_.get(), samples.data(), count) != count) fail(sf_strerror(out_.get()));
        written_ += count;
    }
}

void RecordingSound::close() {
    sf_write_sync(out_.get());
    if (sf_error(out_.get()) != SF_ERR_NO_ERROR) fail(sf_strerror(out_.get()));
    if (sf_close(out_.release()) != 0) fail("the end could not be written");
    file_.commit();
}

void RecordingSound::fail(const std::string& why) const {
    throw std::runtime_error(fmt::format("{}: cannot write the sound: {}", file_.path().string(), why));
}

}  // namespace osteomill
