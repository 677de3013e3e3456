// A file of sessions and their metrics that an earlier study has read. It only saves time: whatever it holds
// is in the recordings, and it is made again from them when it is missing, damaged or of another version.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "analysis/sessions/session_record.h"

namespace osteomill::study {

class SessionStore {
  public:
    /// `version`: of the programs that filled it; others may measure otherwise.
    SessionStore(std::filesystem::path file, std::string version);

    /// What is kept of the recording with this digest.
    std::optional<SessionRecord> find(const std::string& digest) const;
    /// Replaces what is kept of it.
    void keep(const SessionRecord& record) { kept_[record.digest] = record; }
    /// Throws std::runtime_error naming the file where it cannot be written.
    void write() const;

  private:
    std::filesystem::path file_;
    std::string version_;
    std::map<std::string, SessionRecord> kept_;
};

}  // namespace osteomill::study
