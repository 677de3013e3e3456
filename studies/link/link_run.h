// A run over a link: a burr mills at one end, a client keeps a copy of the bone at the other. It measures the
// bytes on the link, the age of the client's picture, and the voxels in which the copy differs.
//
// Both ends are the program's own (OutgoingFrames, FramePace, SessionReceiver), the link is simulated: it
// carries so many bytes a second, and each byte arrives so much later. All is in steps of a tick on a clock
// of its own, so the same choice gives the same outcome, but for `frame_us`.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>

#include "common/bone/bone.h"
#include "common/scene/burr.h"

namespace osteomill::study {

enum class LinkContent {
    changes,  ///< the voxels that changed, as the server sends them
    bricks,   ///< whole bricks that changed
    poses     ///< the tool alone: the client carves for itself from pose to pose
};

/// Throws std::invalid_argument for a name that is none of changes, bricks, poses.
LinkContent link_content_named(const std::string& name);

struct LinkChoice {
    LinkContent content = LinkContent::changes;
    double frame_rate_hz = 30.0;
    double bytes_per_s = std::numeric_limits<double>::infinity();  ///< that the link takes
    double latency_s = 0.0;                                        ///< on the way
};

struct LinkOutcome {
    double bytes_per_s = 0.0;             ///< sent, over the path, without the snapshot before it
    double most_bytes_in_a_second = 0.0;  ///< counted as bytes_per_s
    double delay_mean_ms = 0.0;           ///< age of the client's picture, over all ticks
    double delay_p99_ms = 0.0;
    double differing_voxels_mean = 0.0;  ///< between the two bones, over all ticks
    std::size_t differing_voxels_most = 0;
    std::size_t differing_voxels_left = 0;  ///< when all has arrived, long after the path's end
    double frame_us = 0.0;                  ///< to make a frame, median
};

/// `positions_mm`: the burr's, each a tick after the one before; it mills all the way. `axis`: the spindle's,
/// unit. Throws std::invalid_argument for a choice that is none and a burr that is no ball.
LinkOutcome run_link(const Bone& bone, const Burr& burr, const glm::dvec3& axis, double tick_s,
                     std::span<const glm::dvec3> positions_mm, const LinkChoice& choice);

}  // namespace osteomill::study
