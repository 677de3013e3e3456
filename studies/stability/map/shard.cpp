#include "studies/stability/map/shard.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "common/text/words.h"
#include "studies/stability/map/map_text.h"

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

std::vector<std::size_t> cases_of(const Shard& shard, const std::vector<MapPoint>& points) {
    std::vector<XXH64_hash_t> lots;
    for (const MapPoint& point : points) lots.push_back(hash_of(json_of(point).dump()));
    std::vector<std::size_t> drawn(points.size());
    std::iota(drawn.begin(), drawn.end(), std::size_t{0});
    std::stable_sort(drawn.begin(), drawn.end(),
                     [&](std::size_t a, std::size_t b) { return lots[a] < lots[b]; });
    std::vector<std::size_t> mine;
    for (std::size_t i = shard.number - 1; i < drawn.size(); i += shard.of) mine.push_back(drawn[i]);
    return mine;
}

std::string fingerprint_of(const std::vector<MapPoint>& points) {
    std::string all = json_of(MapOutcome{}).dump();
    for (const MapPoint& point : points) all += json_of(point).dump();
    return fmt::format("{:016x}", hash_of(all));
}

}  // namespace osteomill::study
