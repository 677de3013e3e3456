#include "studies/stability/map/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include "studies/stability/map/case_file.h"
#include "studies/stability/map/map_text.h"

namespace osteomill::study {

namespace {

std::vector<std::filesystem::path> case_files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("cases-") && name.ends_with(".jsonl")) files.push_back(entry.path());
    }
    if (files.empty()) throw std::runtime_error(folder.string() + ": holds no cases-*.jsonl");
    std::sort(files.begin(), files.end());
    return files;
}

/// One list's cases as they come in.
class Joining {
  public:
    void add(const std::filesystem::path& file) {
        const CaseFile part = read_case_file(file);
        if (!first_) {
            begin(part, file);
        } else if (part.fingerprint != fingerprint_) {
            throw std::runtime_error(
                fmt::format("{}: of another list than {}", file.string(), first_->string()));
        }
        for (const auto& [index, outcome] : part.outcomes) {
            if (index >= map_.points.size())
                throw std::runtime_error(fmt::format("{}: case {} is not on the list", file.string(), index));
            if (from_[index])
                throw std::runtime_error(fmt::format("case {} ({}) is there twice: in {} and in {}", index,
                                                     text_of(map_.points[index].run), from_[index]->string(),
                                                     file.string()));
            from_[index] = file;
            map_.outcomes[index] = outcome;
        }
    }

    WholeMap whole() && {
        const auto missing = std::count(from_.begin(), from_.end(), std::nullopt);
        if (missing > 0) {
            const auto first =
                static_cast<std::size_t>(std::find(from_.begin(), from_.end(), std::nullopt) - from_.begin());
            throw std::runtime_error(fmt::format("{} of {} cases are missing, the first is case {} ({})",
                                                 missing, from_.size(), first,
                                                 text_of(map_.points[first].run)));
        }
        return std::move(map_);
    }

  private:
    void begin(const CaseFile& part, const std::filesystem::path& file) {
        first_ = file;
        fingerprint_ = part.fingerprint;
        map_.selection = part.selection;
        map_.points = map_points(part.selection);
        if (fingerprint_of(map_.points) != fingerprint_)
            throw std::runtime_error(
                file.string() + ": of another version of the list of cases (fingerprint " + fingerprint_ +
                ", this program's is " + fingerprint_of(map_.points) + ")");
        map_.outcomes.resize(map_.points.size());
        from_.resize(map_.points.size());
    }

    std::optional<std::filesystem::path> first_;
    std::string fingerprint_;
    WholeMap map_;
    std::vector<std::optional<std::filesystem::path>> from_;  ///< by case
};

}  // namespace

WholeMap merge(const std::vector<std::filesystem::path>& files_and_folders) {
    Joining joining;
    for (const std::filesystem::path& place : files_and_folders) {
        if (!std::filesystem::is_directory(place)) {
            joining.add(place);
            continue;
        }
        for (const std::filesystem::path& file : case_files_in(place)) joining.add(file);
    }
    return std::move(joining).whole();
}

}  // namespace osteomill::study
