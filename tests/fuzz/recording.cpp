#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <limits>
#include <system_error>

#include "common/recording/playhead.h"
#include "common/recording/recording_reader.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

namespace {

/// A file in memory alone: the disk is not tested, and would be slow.
class MemoryFile {
  public:
    explicit MemoryFile(Bytes bytes) : descriptor_(::memfd_create("recording", MFD_CLOEXEC)) {
        if (descriptor_ < 0 ||
            ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            throw std::system_error(errno, std::generic_category(), "a file in memory");
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

constexpr double for_ever_s = std::numeric_limits<double>::infinity();

/// A tool may use a tick freely: its numbers are finite and its burr exists.
void require_sound(const TickSample& tick, std::size_t burrs) {
    require(tick.burr < burrs, "a burr that the session has not");
    for (const TickQuantity& quantity : tick_quantities())
        require(std::isfinite(quantity.of(tick)), "a number of a tick that is not finite");
}

void play(const std::filesystem::path& file) {
    Playhead playhead(file);
    const Playhead::Mark start = playhead.mark();
    const Bone first = playhead.bone();
    const auto play_to_the_end = [&] {
        for (double time_s = playhead.time_s();; time_s = playhead.time_s()) {
            const Playhead::Step step = playhead.step(for_ever_s);
            require(playhead.time_s() >= time_s, "time goes back");
            require(checksum(playhead.bone()) == playhead.bone_checksum(),
                    "the running checksum is not that of the voxels");
            for (const TickSample& tick : playhead.ticks())
                require_sound(tick, playhead.session().burrs.size());
            if (step == Playhead::Step::end || step == Playhead::Step::new_bone) return step;
        }
    };
    // A mark holds within its session.
    if (play_to_the_end() == Playhead::Step::new_bone) return;
    const std::uint64_t at_the_end = playhead.bone_checksum();
    for (std::size_t slot = 0; slot < first.stored_bricks(); ++slot)
        playhead.set_fractions(first.content().brick_of_slot[slot],
                               first.fractions(static_cast<std::int32_t>(slot)));
    playhead.go_back_to(start);
    play_to_the_end();
    require(playhead.bone_checksum() == at_the_end, "the second time leads to another bone");
}

}  // namespace

void recording(Bytes input) {
    const MemoryFile file(input);
    for (const auto& read : {+[](const std::filesystem::path& path) { play(path); },
                             +[](const std::filesystem::path& path) {
                                 require(outline_of(path).duration_s >= 0.0, "a duration below zero");
                             }})
        try {
            read(file.path());
        } catch (const RecordingError& error) {
            const std::string line = error.what();
            require(!line.empty() && line.find('\n') == std::string::npos,
                    "a complaint that is not one line");
        }
}

}  // namespace osteomill::fuzz
