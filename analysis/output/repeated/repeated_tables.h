// Tables of a study that was repeated, beside those that were kept.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace osteomill::study {

/// One column of one table.
struct RepeatedColumn {
    std::string name;         ///< FILE: COLUMN; of JSON the place, * for any element of a list
    std::size_t differ = 0;   ///< cells that differ by more than the noise
    double difference = 0.0;  ///< the largest, in the column's unit
    double noise = 0.0;       ///< the largest between the two runs that were made now
};

struct RepeatedTables {
    std::size_t columns = 0;                ///< that were compared
    std::vector<RepeatedColumn> different;  ///< by more than noise
    std::vector<std::string> other;         ///< a line for each table that cannot be compared
};

/// Compares every table of `kept`, CSV and JSON, with the same file of `once` and `again`, two runs of the
/// same command. A number differs where both runs are farther from it than noise_margin times its column's
/// noise, what is no number where it is other than in both. A column that is equal in both runs is compared
/// exactly. Throws std::runtime_error in one line naming a file that cannot be read.
RepeatedTables compare_tables(const std::filesystem::path& kept, const std::filesystem::path& once,
                              const std::filesystem::path& again);

inline constexpr double noise_margin = 2.0;

}  // namespace osteomill::study
