// A small SQLite file of sessions and their metrics. It only saves time: whatever it holds is in the
// recordings, and it is made again from them when it is missing, damaged or of another version.
//
//     session(digest PRIMARY KEY, file, trainee, case_name, began_unix_ns)
//     metric(digest, place, key, of, value, unit, text)
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "analysis/sessions/session_record.h"

struct sqlite3;

namespace osteomill::study {

class SessionStore {
  public:
    /// Of the programs that filled it: other versions may measure otherwise. Throws std::runtime_error naming
    /// the file where it can be neither read nor made.
    SessionStore(const std::filesystem::path& file, const std::string& version);

    /// What is kept of the recording with this digest.
    std::optional<SessionRecord> find(const std::string& digest) const;
    /// Replaces what is kept of it.
    void keep(const SessionRecord& record);

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    bool open(const std::string& version);
    void execute(const std::string& sql) const;
    [[noreturn]] void fail(const std::string& what) const;

    std::filesystem::path file_;
    std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace osteomill::study
