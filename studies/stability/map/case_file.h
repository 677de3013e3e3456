// The file of a part of the map while it runs and after: JSON lines, the first saying of which list they are,
// then one for each case that is done.
//
//     {"map":"osteomill stability","fingerprint":"...","cases":930,"shard":1,"of":2,"selection":{...}}
//     {"case":17,"is_stable":true,...}
//
// A line is written at once, so that a process that is killed loses the cases it was at, and at most the last
// line is torn; whoever takes the file up again cuts that off.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "studies/stability/map/map_outcome.h"
#include "studies/stability/map/map_points.h"
#include "studies/stability/map/shard.h"

namespace osteomill::study {

/// FOLDER/cases-I-of-N.jsonl
std::filesystem::path case_file_of(const Shard& shard, const std::filesystem::path& folder);

struct CaseFile {
    std::string fingerprint;
    MapSelection selection;
    Shard shard;
    std::map<std::size_t, MapOutcome> outcomes{};  ///< by index into the list
};

/// What a file holds; a torn last line is passed over. Throws std::runtime_error in one line for a file that
/// cannot be read, is no file of cases, has a line that is none, or has a case twice.
CaseFile read_case_file(const std::filesystem::path& file);

/// Appends to a file, alone: a second writer is refused while this one lives. One thread at a time.
class CaseFileWriter {
  public:
    /// Makes the file, or takes up one of the same list. Throws std::runtime_error in one line where the file
    /// is of another list or part, is being written by another process, or cannot be written.
    CaseFileWriter(const std::filesystem::path& file, const MapSelection& selection,
                   const std::vector<MapPoint>& points, const Shard& shard);
    ~CaseFileWriter();
    CaseFileWriter(const CaseFileWriter&) = delete;
    CaseFileWriter& operator=(const CaseFileWriter&) = delete;

    /// What the file held when it was opened.
    const std::map<std::size_t, MapOutcome>& done_before() const { return done_before_; }

    /// Throws std::runtime_error where the line cannot be written.
    void append(std::size_t index, const MapOutcome& outcome);

  private:
    void write_line(const std::string& line);
    void take_up(const std::string& fingerprint, const Shard& shard);

    std::filesystem::path file_;
    int descriptor_ = -1;
    std::map<std::size_t, MapOutcome> done_before_;
};

}  // namespace osteomill::study
