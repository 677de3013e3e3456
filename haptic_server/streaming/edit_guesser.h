// Packs what changed in the bone as what differs from a guess (see guessed_edits.h), for all clients that are
// to be told the same: those that keep up are, so they share the work.
#pragma once

#include <optional>
#include <vector>

#include "common/wire/guessed_edits.h"
#include "haptic_server/streaming/bone_mirror.h"

namespace osteomill {

/// Between two frames of a client, in voxels of its bone.
struct BurrMotion {
    glm::dvec3 from{0.0};
    glm::dvec3 to{0.0};  ///< about: where the burr is shown
    double radius = 0.0;
    double smoothing = 0.0;  ///< of what it leaves of voxels: see swept_guess.h

    bool operator==(const BurrMotion&) const = default;
};

class EditGuesser {
  public:
    struct Guessed {
        v1::GuessedEdits edits;
        glm::dvec3 burr{0.0};  ///< where the burr is, by what it left; the next motion begins there
    };

    /// Of changed bricks whose masks and fractions do not exceed largest_guessed_edits_bytes. The reference
    /// holds until the next call.
    const Guessed& guess(const BoneMirror& mirror, std::vector<ChangedBrick> bricks,
                         const std::optional<BurrMotion>& motion);

  private:
    GuessedEditsPacker packer_;
    // The last question, and the answer to it.
    std::uint64_t version_ = 0;
    std::vector<ChangedBrick> bricks_;
    std::optional<BurrMotion> motion_;
    Guessed guessed_;
};

}  // namespace osteomill
