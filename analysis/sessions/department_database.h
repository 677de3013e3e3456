// A department's PostgreSQL database of sessions: what its stations have recorded, for others to query.
#pragma once

#include <span>
#include <string>

#include "analysis/sessions/session_record.h"

namespace osteomill::study {

/// Adds the sessions to the tables of session_store.h, which are made where they are not there; one that is
/// there already, by its digest, is replaced. All of them or none: several stations may do so at once, and
/// lose nothing. `url` is libpq's (postgresql://user@host/name). Throws std::runtime_error in one line where
/// the database cannot be reached or written.
void add_to_database(const std::string& url, std::span<const SessionRecord> sessions);

}  // namespace osteomill::study
