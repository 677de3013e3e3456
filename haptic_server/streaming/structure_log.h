// Log lines about protected structures: a line when the burr comes within the structure's warning distance,
// and a line when it begins to touch it.
//
// A burr that hovers at the limit is logged once: before the next warning it must move away to one and a half
// times the distance. Bounded: at most most_lines, however long the session.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/scene/scene.h"
#include "common/session/structure_distance.h"

namespace osteomill {

class StructureLog {
  public:
    static constexpr std::size_t most_lines = 200;

    /// `tissues`: those that distances name by their index.
    explicit StructureLog(std::vector<Tissue> tissues)
        : tissues_(std::move(tissues)), is_warned_of_(tissues_.size()), touches_logged_(tissues_.size()) {}

    /// The lines due now, mostly none.
    std::vector<std::string> lines(std::span<const StructureDistance> distances, double time_s);

  private:
    void say(std::vector<std::string>& lines, std::string line);

    std::vector<Tissue> tissues_;
    std::vector<bool> is_warned_of_;             // by tissue
    std::vector<std::uint32_t> touches_logged_;  // by tissue
    std::size_t said_ = 0;
};

}  // namespace osteomill
