#include "common/recording/recording_writer.h"

#include <atomic>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "common/files/session_file.h"

namespace osteomill {

namespace {

SessionFile begun(const std::filesystem::path& file) try {
    return SessionFile(file);
} catch (const std::runtime_error& error) {
    throw RecordingError(error.what());
}

}  // namespace

struct RecordingWriter::Part final : Sink {
    Part(const std::filesystem::path& path, OnNews its_on_news, WhenDiskIsFull when_full)
        : file(begun(path)), packets(file.part()), on_news(std::move(its_on_news)) {
        if (when_full == WhenDiskIsFull::try_again) retry_period = RecordingWriter::retry_period;
        standstill = packets.file().string() + ": the disk does not answer; the recording ends there";
    }
    ~Part() override {
        if (is_worth_keeping && packets.packets() > 0) file.keep_part();
    }

    void write(const RecordedFrame& frame) override {
        try {
            packets.write(frame.stamp, frame.message);
        } catch (const std::exception& failure) {
            if (retry_period) throw;
            throw RecordingError(std::string(failure.what()) + "; the recording ends there");
        }
    }
    void complete() override {
        if (is_to_be_whole) file.commit();
    }
    void note(const std::string& error) override {
        frames = packets.packets();
        bytes = packets.bytes();
        if (stands_still == !error.empty()) return;
        stands_still = !stands_still;
        if (!stands_still) ++pauses;
        if (on_news && stands_still) on_news(RecordingNews::stands_still, error);
        if (on_news && !stands_still)
            on_news(
                RecordingNews::goes_on,
                packets.file().string() + ": the recording goes on, with all that its bone lost meanwhile");
    }

    SessionFile file;
    PacketWriter packets;  // the thread's
    const OnNews on_news;
    bool stands_still = false;  // the thread's
    std::atomic<bool> is_to_be_whole{false};
    std::atomic<bool> has_its_name{false};
    std::atomic<bool> is_worth_keeping{true};
    std::atomic<std::uint64_t> frames{0};
    std::atomic<std::uint64_t> bytes{packets.bytes()};
    std::atomic<std::uint64_t> pauses{0};
};

RecordingWriter::RecordingWriter(const std::filesystem::path& file, OnNews on_news, WhenDiskIsFull when_full)
    : RecordingWriter(std::make_shared<Part>(file, std::move(on_news), when_full)) {}

RecordingWriter::RecordingWriter(std::shared_ptr<Part> part)
    : BackgroundWriter(part, capacity_bytes), part_(std::move(part)) {
    start();
}

void RecordingWriter::push(Stamp stamp, std::string message) {
    BackgroundWriter::push({stamp, std::move(message)}, true);
}

void RecordingWriter::commit() {
    part_->is_to_be_whole = true;
    if (!finish()) return;
    std::error_code failed;  // it may have its name although its folder could not be synced
    part_->has_its_name = !std::filesystem::exists(part_->file.part(), failed);
}

void RecordingWriter::discard() {
    part_->is_worth_keeping = false;
    finish();
}

RecordingReport RecordingWriter::report() const {
    return {.file = part_->has_its_name ? part_->file.path() : part_->packets.file(),
            .frames = part_->frames,
            .bytes = part_->bytes,
            .pauses = part_->pauses,
            .error = error()};
}

const std::optional<std::filesystem::path>& RecordingWriter::torn() const {
    return part_->file.torn();
}

std::string ending_of(const RecordingReport& report) {
    std::error_code failed;
    if (report.error.empty() || report.frames == 0 || !std::filesystem::is_regular_file(report.file, failed))
        return report.error;
    return report.error + "; what there is lies in " + report.file.string() + ", which packet_replay reads";
}

}  // namespace osteomill
