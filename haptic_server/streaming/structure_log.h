// Log lines about protected structures: a line where the burr comes within the distance at which a
// structure is to be warned of, and one where it begins to touch it.
//
// Who hovers at the limit is named once: a structure that was warned of has to be left by half as much again
// first. Bounded: of a session that goes on and on no more than most_lines.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "common/scene/structure_distance.h"

namespace osteomill {

class StructureLog {
  public:
    static constexpr std::size_t most_lines = 200;

    /// `tissues`: those that distances name by their index.
    explicit StructureLog(std::vector<Tissue> tissues)
        : tissues_(std::move(tissues)), is_warned_of_(tissues_.size()), touches_logged_(tissues_.size()) {}

    /// What is to be said now, mostly nothing.
    std::vector<std::string> lines(std::span<const StructureDistance> distances, double time_s);

  private:
    void say(std::vector<std::string>& lines, std::string line);

    std::vector<Tissue> tissues_;
    std::vector<bool> is_warned_of_;             // by tissue
    std::vector<std::uint32_t> touches_logged_;  // by tissue
    std::size_t said_ = 0;
};

}  // namespace osteomill
