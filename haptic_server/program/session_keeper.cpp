#include "haptic_server/program/session_keeper.h"

#include <spdlog/spdlog.h>

namespace osteomill {

SessionControls::Requests SessionKeeper::requests() {
    return {.save = [this](const Bone& bone) { return save(bone); },
            .finish =
                [this] {
                    wants_end_.store(true);
                    return std::string();
                }};
}

std::string SessionKeeper::save(const Bone& bone) {
    if (!save_) return "the server was started without --save-bone";
    if (is_saving_.exchange(true)) return "the last one is still being saved";
    wait();
    thread_ = std::thread([this, copy = bone] {
        const std::string error = save_(copy);
        if (error.empty())
            spdlog::info("the bone was saved");
        else
            spdlog::error("the bone was not saved: {}", error);
        is_saving_.store(false);
    });
    return {};
}

}  // namespace osteomill
