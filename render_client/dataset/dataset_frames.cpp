#include "render_client/dataset/dataset_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/recording/recording_outline.h"

namespace osteomill {

DatasetFrames::DatasetFrames(std::filesystem::path recording, DatasetContents contents,
                             std::function<void(const Playhead&)> on_session)
    : contents_(std::move(contents)), on_session_(std::move(on_session)), playhead_(recording) {
    require_view(
        contents_.cameras, [&] { return outline_of(recording).has_view; }, recording);
    begin_session();
}

std::optional<DatasetFrame> DatasetFrames::next(const std::function<bool()>& stop_requested) {
    while (!stop_requested()) {
        const Playhead::Step step = playhead_.step(std::numeric_limits<double>::infinity());
        if (step == Playhead::Step::end) return std::nullopt;
        if (step == Playhead::Step::new_bone) begin_session();
        if (step != Playhead::Step::state || has_more_of_this_instant() || !is_due()) continue;
        const std::size_t number = count_++;
        images_->follow();
        if (contents_.part.has(number)) return draw(number);
    }
    return std::nullopt;
}

void DatasetFrames::begin_session() {
    images_.emplace(playhead_, contents_.cameras, contents_.look, contents_.limits);
    ++sessions_;
    on_session_(playhead_);
}

/// The changes of one instant may come in several states.
bool DatasetFrames::has_more_of_this_instant() const {
    const StateArrived* next = playhead_.next_state();
    return next != nullptr && next->state.tool.time_s == playhead_.tool()->time_s &&
           playhead_.next_time_s() == playhead_.time_s();
}

/// From a time on every state, or the first at or behind the beginning of each period.
bool DatasetFrames::is_due() {
    if (playhead_.time_s() < contents_.from_s) return false;
    if (!contents_.frames_per_s) return true;
    // On the virtual clock a state lies on a period's beginning, but for rounding.
    const double period = std::floor(playhead_.time_s() * *contents_.frames_per_s + 1e-6);
    return period > std::exchange(period_, std::max(period_, period));
}

DatasetFrame DatasetFrames::draw(std::size_t number) {
    const DatasetImages& wanted = contents_.images;
    const bool is_randomised = contents_.randomise.has_value();
    DatasetFrame frame{.number = number, .session = sessions_ - 1};
    for (std::size_t i = 0; i < contents_.cameras.size(); ++i) {
        CameraImages images = images_->draw(i, wanted.colour, is_randomised || wanted.has_surface());
        if (is_randomised && wanted.colour) {
            frame.looks.push_back(random_look(*contents_.randomise, number, i,
                                              label_table(playhead_.session().tissues).size()));
            images.colour = looked_at(images, images.pinhole, frame.looks.back());
        }
        frame.images.push_back(std::move(images));
    }
    return frame;
}

}  // namespace osteomill
