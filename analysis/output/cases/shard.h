// A part of a study's cases for one process among several, on one machine or many.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace osteomill::study {

struct Shard {
    std::size_t number = 1;  ///< 1 .. of
    std::size_t of = 1;

    bool operator==(const Shard&) const = default;
};

/// "2/8". Throws std::invalid_argument for anything but I/N with 1 <= I <= N.
Shard shard_named(const std::string& text);

/// Indices of a part's cases into the list of all by name: every case is in exactly one part, and the parts
/// are as long as each other but for one case. They are drawn as by lot, always the same, so that each part
/// has its share of what takes long and the first cases of a part tell how long the rest will take.
std::vector<std::size_t> cases_of(const Shard& shard, const std::vector<std::string>& names);

/// Of a list: changes with a name or the order. Hexadecimal.
std::string fingerprint_of(const std::vector<std::string>& names);

/// Of the program that runs: changes with each build of it. Hexadecimal.
std::string fingerprint_of_program();

}  // namespace osteomill::study
