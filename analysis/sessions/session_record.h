// A session as a study of several keeps it: whose it is, of what, when, and its metrics.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/cases/json_values.h"
#include "analysis/report/session_metrics.h"

namespace osteomill {

/// Its group is not kept.
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(MetricRow, key, of, value, unit, text)

}  // namespace osteomill

namespace osteomill::study {

struct SessionRecord {
    std::string digest{};  ///< of the recording's bytes: 32 hexadecimal digits
    std::string file{};    ///< as it was named
    std::string trainee{};
    std::string case_name{};  ///< or the scene's
    std::int64_t began_unix_ns = 0;
    std::vector<MetricRow> metrics{};
    // Of this study, not of the recording.
    std::string group{};   ///< of the trainee (trainee_groups.h); empty: none
    std::string report{};  ///< address of its report from the overview; empty: there is none
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SessionRecord, digest, file, trainee, case_name, began_unix_ns, metrics)

/// Of the bytes of a file. Throws std::runtime_error where it cannot be read.
std::string digest_of_file(const std::filesystem::path& file);

/// Reads a whole recording. Throws std::runtime_error in one line where it is none, or torn: half a session
/// is not to be compared with whole ones.
SessionRecord record_of(const std::filesystem::path& file, const std::string& digest);

}  // namespace osteomill::study
