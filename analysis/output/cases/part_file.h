// The file of a part of a study while it runs and after: JSON lines, the first saying which cases of which
// command it is for, then one for each case that is done.
//
//     {"study":["stability","--quick"],"program":"...","cases":"...","shard":1,"of":2}
//     {"case":17,"outcome":{"is_stable":true,...}}
//
// A line is written at once, so that a process that is killed loses the cases it was at, and at most the last
// line is torn; a run that continues the file cuts that off. Numbers come back to the last bit; one that is
// not finite is a text such as "number nan", since JSON knows none.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/output/cases/shard.h"

namespace osteomill::study {

/// FOLDER/cases-I-of-N.jsonl
std::filesystem::path part_file_of(const Shard& shard, const std::filesystem::path& folder);

struct PartHeader {
    std::vector<std::string> command{};  ///< the study and its options, without where and how it is run
    std::string program{};               ///< fingerprint of the build that runs it
    std::string cases{};                 ///< fingerprint of the list of all cases
    Shard shard{};

    bool operator==(const PartHeader&) const = default;
};

using Outcomes = std::map<std::size_t, nlohmann::json>;  ///< by index into the list of all cases

struct PartFile {
    PartHeader header;
    Outcomes outcomes{};
};

/// What a file holds; a torn last line is passed over. Throws std::runtime_error in one line for a file that
/// cannot be read, is no file of cases, has a line that is none, or has a case twice.
PartFile read_part_file(const std::filesystem::path& file);

/// Appends to a file, alone: a second writer is refused while this one lives. One thread at a time.
class PartFileWriter {
  public:
    /// Makes the file, or takes up one of the same header. Throws std::runtime_error in one line where the
    /// file is of another one, is being written by another process, or cannot be written.
    PartFileWriter(const std::filesystem::path& file, const PartHeader& header);
    ~PartFileWriter();
    PartFileWriter(const PartFileWriter&) = delete;
    PartFileWriter& operator=(const PartFileWriter&) = delete;

    /// What the file held when it was opened.
    const Outcomes& done_before() const { return done_before_; }

    /// Throws std::runtime_error where the line cannot be written.
    void append(std::size_t index, const nlohmann::json& outcome);

  private:
    void write_line(const std::string& line);
    void take_up(const PartHeader& header);

    std::filesystem::path file_;
    int descriptor_ = -1;
    Outcomes done_before_;
};

}  // namespace osteomill::study
