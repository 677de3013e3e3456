// Factors by which the edge forces in a tissue exceed those that its stiffness implies; the edge forces of
// scenes with such tissues are weighted by them.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "common/scene/scene.h"

namespace osteomill {

/// By tissue label: relative edge force over relative stiffness.
struct EdgeShares {
    EdgeShares() { of_label.fill(1.0f); }
    explicit EdgeShares(const std::vector<Tissue>& tissues) : EdgeShares() {
        for (const Tissue& tissue : tissues)
            if (tissue.strength)
                of_label[tissue.label] =
                    static_cast<float>(tissue.strength->relative_edge / tissue.strength->relative_stiffness);
    }

    /// In every tissue edges rub as its stiffness implies.
    bool are_all_one() const {
        return std::all_of(of_label.begin(), of_label.end(), [](float share) { return share == 1.0f; });
    }

    std::array<float, 256> of_label;
};

}  // namespace osteomill
