#include "haptic_server/session/save_and_finish.h"

#include <fmt/format.h>

#include <utility>

#include "analysis/surface/mesh_file.h"
#include "common/log/log.h"

namespace osteomill {

ControlRunner::Requests SaveAndFinish::requests() {
    return {.save = [this](const Bone& bone, const std::string& ending) { return save(bone, ending); },
            .finish =
                [this] {
                    wants_end_.store(true);
                    return std::string();
                },
            .save_news = [this] { return take_news(); },
            .recording_problem = [this] { return recording_problem(); }};
}

void SaveAndFinish::tell(const std::string& line) {
    log_error("{}", line);
    const std::lock_guard lock(mutex_);
    news_.push_back(line);
}

void SaveAndFinish::hear(RecordingNews news, const std::string& line) {
    const std::lock_guard lock(mutex_);
    recording_problem_ = news == RecordingNews::stands_still ? line : std::string();
}

std::string SaveAndFinish::recording_problem() {
    const std::lock_guard lock(mutex_);
    return recording_problem_;
}

std::vector<std::string> SaveAndFinish::take_news() {
    const std::lock_guard lock(mutex_);
    return std::exchange(news_, {});
}

std::string SaveAndFinish::save(const Bone& bone, const std::string& mesh_ending) {
    // The server makes the rest of the name: no client chooses a path on this disk.
    if (!mesh_ending.empty() && !is_mesh_ending(mesh_ending))
        return fmt::format("a surface is saved as {}", mesh_endings);
    if (!save_) return "this server has no place for it; whoever starts the server can name one";
    if (is_saving_.exchange(true)) return "the last one is still being saved";
    wait();
    thread_ = std::thread([this, copy = bone, mesh_ending] {
        const std::string wrong = save_(copy, mesh_ending);
        if (wrong.empty())
            log_info("the bone was saved{}", mesh_ending.empty() ? "" : " as a surface, " + mesh_ending);
        else
            tell(wrong);
        is_saving_.store(false);
    });
    return {};
}

}  // namespace osteomill
