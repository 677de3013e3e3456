// Parts of a study that ran apart, joined: their command and the outcomes of all cases.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/cases/part_file.h"

namespace osteomill::study {

class JoinedParts {
  public:
    /// From files of cases and folders that hold them (cases-*.jsonl). Throws std::runtime_error in one line
    /// where there is no file, the files are of different commands or another build of this program, or a
    /// part is missing or there twice.
    explicit JoinedParts(const std::vector<std::filesystem::path>& files_and_folders);

    /// The study and its options.
    const std::vector<std::string>& command() const { return parts_.front().content.header.command; }

    /// Of the cases of these names, in their order. Throws std::runtime_error in one line where the parts are
    /// of another list, or one has not done all of its cases.
    std::vector<nlohmann::json> outcomes(const std::vector<std::string>& names) const;

  private:
    struct Part {
        std::filesystem::path file;
        PartFile content;
    };
    void add(const std::filesystem::path& file);

    std::vector<Part> parts_;
};

}  // namespace osteomill::study
