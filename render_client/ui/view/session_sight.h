// The elements of a session that a picture may show: those that belong to the session and the bone in view,
// and are up to date.
#pragma once

#include "render_client/link/session_source.h"

namespace osteomill {

/// A server sends 30 frames a second: after so long a silence its state counts as old.
inline constexpr double longest_fresh_s = 0.25;

enum class SessionSight {
    none,       ///< no server has been reached yet
    coming,     ///< its bone is on the way
    preparing,  ///< and not drawn yet
    now,        ///< the picture is the session's, or the recording's
    silent,     ///< the server says nothing
    lost,       ///< the link broke, or is refused
    over        ///< the picture is of the ended session
};

/// `has_bone`: that of this session is drawn, or cannot be drawn.
constexpr SessionSight sight_of(const LinkUpdate& link, bool has_bone, bool is_recording) {
    switch (link.status) {
        case LinkStatus::connecting:
            return SessionSight::none;
        case LinkStatus::receiving_snapshot:
            return SessionSight::coming;
        case LinkStatus::lost:
        case LinkStatus::refused:
            return SessionSight::lost;
        case LinkStatus::finished:
            return SessionSight::over;
        case LinkStatus::live:
            break;
    }
    if (!is_recording && link.silent_s > longest_fresh_s) return SessionSight::silent;
    return has_bone ? SessionSight::now : SessionSight::preparing;
}

struct SightElements {
    bool tool = false;       ///< burr, spindle, force, distances, warnings, sound
    bool controls = false;   ///< buttons, keys and mouse act on the session
    bool is_grey = false;    ///< the picture is not current
    bool has_words = false;  ///< in the middle: the cause and the remedy
};

constexpr SightElements elements_of(SessionSight sight) {
    switch (sight) {
        case SessionSight::none:
            return {.has_words = true};
        case SessionSight::coming:
        case SessionSight::preparing:
        case SessionSight::silent:
        case SessionSight::lost:
            return {.is_grey = true, .has_words = true};
        case SessionSight::now:
            return {.tool = true, .controls = true};
        case SessionSight::over:
            return {.tool = true};
    }
    return {};
}

}  // namespace osteomill
