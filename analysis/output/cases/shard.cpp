#include "analysis/output/cases/shard.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "common/text/words.h"

namespace osteomill::study {

namespace {

XXH64_hash_t hash_of(const std::string& text) {
    return XXH3_64bits(text.data(), text.size());
}

}  // namespace

Shard shard_named(const std::string& text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto number = [&](std::size_t from, std::size_t count) {
        return parse_number<std::size_t>(std::string_view(text).substr(std::min(from, text.size()), count))
            .value_or(0);
    };
    const Shard shard{number(0, slash), number(slash + 1, std::string::npos)};
    if (shard.number < 1 || shard.number > shard.of)
        throw std::invalid_argument("'" + text + "' is no part I/N with 1 <= I <= N, such as 2/8");
    return shard;
}

std::vector<std::size_t> cases_of(const Shard& shard, const std::vector<std::string>& names) {
    std::vector<XXH64_hash_t> lots;
    for (const std::string& name : names) lots.push_back(hash_of(name));
    std::vector<std::size_t> drawn(names.size());
    std::iota(drawn.begin(), drawn.end(), std::size_t{0});
    std::stable_sort(drawn.begin(), drawn.end(),
                     [&](std::size_t a, std::size_t b) { return lots[a] < lots[b]; });
    std::vector<std::size_t> mine;
    for (std::size_t i = shard.number - 1; i < drawn.size(); i += shard.of) mine.push_back(drawn[i]);
    return mine;
}

std::string fingerprint_of(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += name + '\n';
    return fmt::format("{:016x}", hash_of(all));
}

std::string fingerprint_of_program() {
    static const std::string fingerprint = [] {
        std::ifstream program("/proc/self/exe", std::ios::binary);
        std::ostringstream bytes;
        bytes << program.rdbuf();
        return fmt::format("{:016x}", hash_of(bytes.str()));
    }();
    return fingerprint;
}

}  // namespace osteomill::study
