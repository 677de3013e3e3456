#include "render_client/dataset/known_shanks.h"

#include "common/scene/scene_file.h"

namespace osteomill {

void KnownShanks::take_in(const SessionInfo* session) {
    if (session == nullptr || session->scene_toml == scene_toml_) return;
    scene_toml_ = session->scene_toml;
    shanks_.clear();
    if (scene_toml_.empty()) return;
    try {
        for (const Burr& burr : parse_scene(scene_toml_, "the session's scene").burrs)
            shanks_.push_back(burr.shank);
    } catch (const SceneError&) {
        // A server that knows more than this client sent it: burrs have the usual shank.
        shanks_.clear();
    }
    if (shanks_.size() != session->burrs.size()) shanks_.clear();
}

const ShankProfile& KnownShanks::of(std::size_t burr) const {
    static const ShankProfile none;
    return burr < shanks_.size() ? shanks_[burr] : none;
}

}  // namespace osteomill
