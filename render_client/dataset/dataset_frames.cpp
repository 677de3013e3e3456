#include "render_client/dataset/dataset_frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/recording/recording_reader.h"

namespace osteomill {

DatasetFrames::DatasetFrames(std::filesystem::path recording, DatasetContents contents,
                             std::function<void(const ImagedSession&)> on_session)
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
        if (contents_.part.has(number)) {
            DatasetFrame frame = draw_frame(*images_, contents_, number, drawn_);
            frame.session = sessions_ - 1;
            return frame;
        }
    }
    return std::nullopt;
}

void DatasetFrames::begin_session() {
    images_.emplace(drawn_, contents_.cameras, contents_.look, contents_.limits);
    ++sessions_;
    on_session_(drawn_);
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

DatasetFrame draw_frame(SessionImages& images, const DatasetContents& contents, std::size_t number,
                        const ImagedSession& session) {
    const DatasetImages& wanted = contents.images;
    const bool is_randomised = contents.randomise.has_value();
    DatasetFrame frame{.number = number};
    for (std::size_t i = 0; i < contents.cameras.size(); ++i) {
        CameraImages drawn = images.draw(i, wanted.colour, is_randomised || wanted.has_surface());
        if (is_randomised && wanted.colour) {
            frame.looks.push_back(
                random_look(*contents.randomise, number, i, label_table(session.session().tissues).size()));
            drawn.colour = looked_at(drawn, drawn.pinhole, frame.looks.back());
        }
        frame.images.push_back(std::move(drawn));
    }
    return frame;
}

}  // namespace osteomill
