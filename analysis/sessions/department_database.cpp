#include "analysis/sessions/department_database.h"

#include <fmt/format.h>

#include <pqxx/pqxx>
#include <stdexcept>

#include "common/text/address_text.h"
#include "common/text/plain_text.h"

namespace osteomill::study {

namespace {

constexpr const char* department_tables = R"(
CREATE TABLE IF NOT EXISTS session(digest TEXT PRIMARY KEY, file TEXT NOT NULL, trainee TEXT NOT NULL,
    case_name TEXT NOT NULL, began_unix_ns BIGINT NOT NULL);
CREATE TABLE IF NOT EXISTS metric(digest TEXT NOT NULL REFERENCES session ON DELETE CASCADE, place INTEGER NOT NULL,
    key TEXT NOT NULL, of TEXT NOT NULL, value DOUBLE PRECISION, unit TEXT NOT NULL, text TEXT NOT NULL,
    PRIMARY KEY(digest, place));
)";

/// Whoever adds sessions has this lock until its transaction ends; any number that is always the same.
constexpr const char* one_at_a_time = "SELECT pg_advisory_xact_lock(1869836397)";

/// $1, $2 ... of the command are the values; libpqxx 7.10 (Debian 13) deprecates what 6.4 (Debian 12) has for
/// it.
template <typename... Values>
void execute(pqxx::work& work, const char* command, const Values&... values) {
#if PQXX_VERSION_MAJOR > 7 || (PQXX_VERSION_MAJOR == 7 && PQXX_VERSION_MINOR >= 10)
    work.exec(command, pqxx::params{values...});
#else
    work.exec_params(command, values...);
#endif
}

void add(pqxx::work& work, const SessionRecord& session) {
    execute(work, "DELETE FROM session WHERE digest = $1", session.digest);
    execute(work, "INSERT INTO session VALUES($1, $2, $3, $4, $5)", session.digest, session.file,
            session.trainee, session.case_name, session.began_unix_ns);
    int place = 0;
    for (const MetricRow& metric : session.metrics) {
        const std::string value = metric.value ? fmt::format("{}", *metric.value) : "";
        execute(work, "INSERT INTO metric VALUES($1, $2, $3, $4, $5, $6, $7)", session.digest, place++,
                metric.key, metric.of, metric.value ? value.c_str() : nullptr, metric.unit, metric.text);
    }
}

}  // namespace

void add_to_database(const std::string& url, std::span<const SessionRecord> sessions) {
    try {
        pqxx::connection connection(url);
        pqxx::work work(connection);
        work.exec(one_at_a_time);
        work.exec(department_tables);
        for (const SessionRecord& session : sessions) add(work, session);
        work.commit();
    } catch (const pqxx::failure& error) {
        // The first line says what is wrong.
        const std::string why = error.what();
        throw std::runtime_error(
            without_passwords(fmt::format("{}: {}", url, printable(why.substr(0, why.find('\n'))))));
    }
}

}  // namespace osteomill::study
