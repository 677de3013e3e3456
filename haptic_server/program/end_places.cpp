#include "haptic_server/program/end_places.h"

#include <utility>

namespace osteomill {

EndPlaces::EndPlaces(const OutputFiles& files) : files_(files) {
    if (files.save_bone) save_bone_.emplace(*files.save_bone);
    if (files.json) json_.emplace(*files.json);
    if (files.json_histograms) histograms_.emplace(*files.json_histograms);
}

OutputFiles EndPlaces::now() const {
    OutputFiles files = files_;
    if (save_bone_) files.save_bone = save_bone_->now();
    if (json_) files.json = json_->now();
    if (histograms_) files.json_histograms = histograms_->now();
    return files;
}

std::vector<std::string> EndPlaces::look(const BoneSource& source) {
    constexpr std::chrono::milliseconds between_looks{500};
    next_look_ = std::chrono::steady_clock::now() + between_looks;
    std::vector<std::string> lines;
    for (std::optional<OutputPlace>* const place : {&save_bone_, &json_, &histograms_})
        if (std::string line = *place ? (*place)->news() : ""; !line.empty())
            lines.push_back(std::move(line));
    if (save_bone_ && !source_is_lost_)
        if (std::string line = why_source_is_lost(source); !line.empty()) {
            source_is_lost_ = true;
            lines.push_back(std::move(line));
        }
    return lines;
}

}  // namespace osteomill
