#include "analysis/output/cases/joined_parts.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace osteomill::study {

namespace {

std::vector<std::filesystem::path> part_files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("cases-") && name.ends_with(".jsonl")) files.push_back(entry.path());
    }
    if (files.empty()) throw std::runtime_error(folder.string() + ": holds no cases-*.jsonl");
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

JoinedParts::JoinedParts(const std::vector<std::filesystem::path>& files_and_folders) {
    for (const std::filesystem::path& place : files_and_folders) {
        if (!std::filesystem::is_directory(place)) {
            add(place);
            continue;
        }
        for (const std::filesystem::path& file : part_files_in(place)) add(file);
    }
    const std::size_t of = parts_.at(0).content.header.shard.of;
    std::vector<std::size_t> missing;
    for (std::size_t number = 1; number <= of; ++number)
        if (std::none_of(parts_.begin(), parts_.end(), [&](const Part& part) {
                return part.content.header.shard.number == number;
            }))
            missing.push_back(number);
    if (!missing.empty())
        throw std::runtime_error(
            fmt::format("missing of {} parts: {}", of, fmt::join(missing, ", ")));
}

void JoinedParts::add(const std::filesystem::path& file) {
    Part part{file, read_part_file(file)};
    const PartHeader& header = part.content.header;
    if (header.program != fingerprint_of_program())
        throw std::runtime_error(file.string() + ": was made by another build of this program");
    for (const Part& other : parts_) {
        PartHeader expected = other.content.header;
        if (expected.shard == header.shard)
            throw std::runtime_error(fmt::format("part {} is there twice: in {} and in {}",
                                                 header.shard.number, other.file.string(), file.string()));
        expected.shard.number = header.shard.number;
        if (expected != header)
            throw std::runtime_error(
                fmt::format("{}: of another list than {}", file.string(), other.file.string()));
    }
    parts_.push_back(std::move(part));
}

std::vector<nlohmann::json> JoinedParts::outcomes(const std::vector<std::string>& names) const {
    std::vector<nlohmann::json> all(names.size());
    for (const Part& part : parts_) {
        const PartHeader& header = part.content.header;
        if (header.cases != fingerprint_of(names))
            throw std::runtime_error(part.file.string() + ": is of another list of cases than '" +
                                     fmt::format("{}", fmt::join(command(), " ")) + "' has here");
        const std::vector<std::size_t> its = cases_of(header.shard, names);
        for (const std::size_t index : its) {
            const auto found = part.content.outcomes.find(index);
            if (found == part.content.outcomes.end())
                throw std::runtime_error(
                    fmt::format("{}: has done {} of its {} cases, not '{}': run part {}/{} again, which goes "
                                "on there",
                                part.file.string(), part.content.outcomes.size(), its.size(), names[index],
                                header.shard.number, header.shard.of));
            all[index] = found->second;
        }
    }
    return all;
}

}  // namespace osteomill::study
