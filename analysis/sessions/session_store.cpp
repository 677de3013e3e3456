#include "analysis/sessions/session_store.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <stdexcept>

namespace osteomill::study {

namespace {

struct Finalize {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// One prepared statement; parameters are bound in order, columns read by number.
class Statement {
  public:
    Statement(sqlite3* database, const char* sql) {
        sqlite3_stmt* statement = nullptr;
        is_good_ = sqlite3_prepare_v2(database, sql, -1, &statement, nullptr) == SQLITE_OK;
        statement_.reset(statement);
    }
    Statement& bind(const std::string& text) {
        return note(sqlite3_bind_text(statement_.get(), ++bound_, text.data(), static_cast<int>(text.size()),
                                      SQLITE_TRANSIENT));
    }
    Statement& bind(std::int64_t number) {
        return note(sqlite3_bind_int64(statement_.get(), ++bound_, number));
    }
    Statement& bind(const std::optional<double>& number) {
        ++bound_;
        return note(number ? sqlite3_bind_double(statement_.get(), bound_, *number)
                           : sqlite3_bind_null(statement_.get(), bound_));
    }
    /// Whether there is a row.
    bool step() {
        if (!is_good_) return false;
        const int result = sqlite3_step(statement_.get());
        is_good_ = result == SQLITE_ROW || result == SQLITE_DONE;
        return result == SQLITE_ROW;
    }
    bool is_good() const { return is_good_; }
    std::string text(int column) const {
        const auto* bytes = sqlite3_column_text(statement_.get(), column);
        return bytes == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(bytes));
    }
    std::int64_t number(int column) const { return sqlite3_column_int64(statement_.get(), column); }
    std::optional<double> value(int column) const {
        if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
        return sqlite3_column_double(statement_.get(), column);
    }

  private:
    Statement& note(int result) {
        is_good_ = is_good_ && result == SQLITE_OK;
        return *this;
    }

    std::unique_ptr<sqlite3_stmt, Finalize> statement_;
    bool is_good_ = false;
    int bound_ = 0;
};

constexpr int busy_ms = 30'000;

constexpr const char* tables = R"(
CREATE TABLE IF NOT EXISTS made_by(version TEXT PRIMARY KEY);
CREATE TABLE IF NOT EXISTS session(digest TEXT PRIMARY KEY, file TEXT NOT NULL, trainee TEXT NOT NULL,
    case_name TEXT NOT NULL, began_unix_ns INTEGER NOT NULL);
CREATE TABLE IF NOT EXISTS metric(digest TEXT NOT NULL REFERENCES session, place INTEGER NOT NULL, key TEXT NOT NULL,
    of TEXT NOT NULL, value REAL, unit TEXT NOT NULL, text TEXT NOT NULL, PRIMARY KEY(digest, place));
)";

}  // namespace

void SessionStore::Close::operator()(sqlite3* database) const {
    sqlite3_close(database);
}

SessionStore::SessionStore(const std::filesystem::path& file, const std::string& version) : file_(file) {
    std::error_code ignored;
    // Its name is ours, and what a link of that name leads to is not.
    if (std::filesystem::is_symlink(file_, ignored)) std::filesystem::remove(file_, ignored);
    if (open(version)) return;
    // It only saves time.
    database_.reset();
    std::filesystem::remove(file_, ignored);
    if (!open(version)) fail("cannot be made");
}

bool SessionStore::open(const std::string& version) {
    sqlite3* database = nullptr;
    const int result = sqlite3_open(file_.c_str(), &database);
    database_.reset(database);
    if (result != SQLITE_OK) return false;
    sqlite3_busy_timeout(database, busy_ms);  // another study may be writing it
    if (sqlite3_exec(database, tables, nullptr, nullptr, nullptr) != SQLITE_OK) return false;
    Statement made_by(database, "SELECT version FROM made_by");
    if (made_by.step()) return made_by.text(0) == version;
    if (!made_by.is_good()) return false;
    Statement insert(database, "INSERT INTO made_by VALUES(?)");
    insert.bind(version).step();
    // Also reads the tables' columns: a file of that name may have others.
    Statement session(database, "SELECT digest, file, trainee, case_name, began_unix_ns FROM session");
    session.step();
    return insert.is_good() && session.is_good();
}

std::optional<SessionRecord> SessionStore::find(const std::string& digest) const {
    Statement session(database_.get(),
                      "SELECT file, trainee, case_name, began_unix_ns FROM session WHERE digest = ?");
    if (!session.bind(digest).step()) {
        if (!session.is_good()) fail("cannot be read");
        return std::nullopt;
    }
    SessionRecord record{.digest = digest,
                         .file = session.text(0),
                         .trainee = session.text(1),
                         .case_name = session.text(2),
                         .began_unix_ns = session.number(3)};
    Statement metric(database_.get(),
                     "SELECT key, of, value, unit, text FROM metric WHERE digest = ? ORDER BY place");
    metric.bind(digest);
    while (metric.step())
        record.metrics.push_back({.group = {},
                                  .key = metric.text(0),
                                  .of = metric.text(1),
                                  .text = metric.text(4),
                                  .value = metric.value(2),
                                  .unit = metric.text(3)});
    if (!metric.is_good()) fail("cannot be read");
    return record;
}

void SessionStore::keep(const SessionRecord& record) {
    execute("BEGIN");
    bool is_good = true;
    for (const char* sql : {"DELETE FROM metric WHERE digest = ?", "DELETE FROM session WHERE digest = ?"}) {
        Statement remove(database_.get(), sql);
        remove.bind(record.digest).step();
        is_good = is_good && remove.is_good();
    }
    Statement session(database_.get(), "INSERT INTO session VALUES(?, ?, ?, ?, ?)");
    session.bind(record.digest).bind(record.file).bind(record.trainee).bind(record.case_name);
    session.bind(record.began_unix_ns).step();
    is_good = is_good && session.is_good();
    std::int64_t place = 0;
    for (const MetricRow& kept : record.metrics) {
        Statement metric(database_.get(), "INSERT INTO metric VALUES(?, ?, ?, ?, ?, ?, ?)");
        metric.bind(record.digest).bind(place++).bind(kept.key).bind(kept.of);
        metric.bind(kept.value).bind(kept.unit).bind(kept.text).step();
        is_good = is_good && metric.is_good();
    }
    if (!is_good) fail("cannot be written");
    execute("COMMIT");
}

void SessionStore::execute(const std::string& sql) const {
    if (sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
        fail("cannot be written");
}

void SessionStore::fail(const std::string& what) const {
    const char* why = database_ ? sqlite3_errmsg(database_.get()) : "no memory";
    throw std::runtime_error(fmt::format("{}: {}: {}", file_.string(), what, why));
}

}  // namespace osteomill::study
