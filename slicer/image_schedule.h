// Schedule of an image's parts, for a receiver that drops messages silently.
//
// OpenIGTLinkIF of 3D Slicer keeps only the newest message of a type and name between two imports, and
// imports when its window has time. So a part covers all changes of the last 5 s, and is sent 5 times a
// second at most. The whole is sent in the first 5 s, at rest, and every 10 s while something changes. A
// receiver that imports every 3 s ends with the same image as one that imports each message.
#pragma once

#include <deque>
#include <optional>

#include "slicer/reduced_bone.h"

namespace osteomill {

class ImageSchedule {
  public:
    static constexpr double covered_s = 5.0;        ///< how far back a part reaches
    static constexpr double between_parts_s = 0.2;  ///< at least
    static constexpr double rests_after_s = 1.0;    ///< without a change
    static constexpr double between_wholes_s = 10.0;

    /// Somebody else receives, or the image is another one: the record of sent parts is cleared.
    void restart(const ReducedBox& whole);
    void changed(const ReducedBox& box, double now_s);

    /// The part to send now; nothing if none is due. It counts as sent. Times ascend.
    std::optional<ReducedBox> next(double now_s);

  private:
    struct Change {
        ReducedBox box;
        std::optional<double> first_sent_s{};
    };
    ReducedBox send_whole(double now_s);

    std::optional<ReducedBox> whole_{};  // nothing: there is no image yet
    std::optional<double> whole_sent_s_{};
    double begun_s_ = 0.0;  // the first whole was sent
    double last_sent_s_ = 0.0;
    double last_change_s_ = 0.0;
    bool has_changed_since_whole_ = false;
    std::deque<Change> changes_{};
};

}  // namespace osteomill
