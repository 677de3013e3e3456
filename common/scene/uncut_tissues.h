// Tissues that no burr cuts, such as an implant or a probe's tip: they stay, and are a wall to the burr.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

struct UncutTissues {
    UncutTissues() = default;
    explicit UncutTissues(const std::vector<Tissue>& tissues) {
        for (const Tissue& tissue : tissues) {
            of_label[tissue.label] = !tissue.is_cuttable;
            has_any = has_any || !tissue.is_cuttable;
        }
    }

    bool has_any = false;
    std::array<bool, 256> of_label{};  ///< by tissue label
};

}  // namespace osteomill
