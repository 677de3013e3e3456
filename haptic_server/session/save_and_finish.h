// Controls of a session under way that act on it as a whole: they save its bone or end it. And what its
// clients are to know of its files: that one cannot be written.
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/bone/bone.h"
#include "common/recording/recording_writer.h"
#include "haptic_server/streaming/control_runner.h"

namespace osteomill {

class SaveAndFinish {
  public:
    /// Writes a bone, or its surface if there is an ending of mesh_endings; returns one line about an error,
    /// or nothing. Called on a thread of its own.
    using Save = std::function<std::string(const Bone&, const std::string& mesh_ending)>;

    /// An empty `save`: there is no file to save in, and it is refused.
    explicit SaveAndFinish(Save save) : save_(std::move(save)) {}
    ~SaveAndFinish() { wait(); }
    SaveAndFinish(const SaveAndFinish&) = delete;
    SaveAndFinish& operator=(const SaveAndFinish&) = delete;

    /// Callbacks for ControlRunner, called on the streaming thread; this object must outlive them. A save
    /// holds a copy of the bone's fractions until it is written; one at a time.
    ControlRunner::Requests requests();

    /// Any thread: in the log, and to clients, as the answer to a save. A failure to save is reported when it
    /// happens.
    void tell(const std::string& line);
    /// Any thread: news of the recording, which has logged them. Clients see that it stands still for as long
    /// as it does.
    void hear(RecordingNews news, const std::string& line);
    /// Any thread.
    bool finish_requested() const { return wants_end_.load(); }
    /// For a save under way, which may take a minute. Once no more can be requested.
    void wait() {
        if (thread_.joinable()) thread_.join();
    }

  private:
    std::string save(const Bone& bone, const std::string& mesh_ending);

    std::vector<std::string> take_news();
    std::string recording_problem();

    Save save_;
    std::mutex mutex_;
    std::vector<std::string> news_;  // that the controls have yet to take
    std::string recording_problem_;
    std::thread thread_;
    std::atomic<bool> is_saving_{false};
    std::atomic<bool> wants_end_{false};
};

}  // namespace osteomill
