#include "common/scene/session_control.h"

namespace osteomill {

const char* name_of(SessionAction action) {
    switch (action) {
        case SessionAction::none:
            return "nothing";
        case SessionAction::mark:
            return "mark";
        case SessionAction::pause:
            return "pause";
        case SessionAction::resume:
            return "resume";
        case SessionAction::undo:
            return "undo";
        case SessionAction::redo:
            return "redo";
        case SessionAction::reset:
            return "reset";
        case SessionAction::save:
            return "save";
        case SessionAction::finish:
            return "finish";
        case SessionAction::place:
            return "place";
        case SessionAction::speed:
            return "speed";
    }
    return "nothing";
}

}  // namespace osteomill
