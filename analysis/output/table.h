// Table of what a study found: named columns and a row a case, as CSV for charts and spreadsheets and as
// JSON.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace osteomill::study {

class Table {
  public:
    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}

    /// As many values as there are columns: texts, numbers, truths; null for an empty cell. Throws
    /// std::logic_error for any other count.
    void add(std::vector<nlohmann::ordered_json> row);

    /// A header and a line a row: numbers with six digits, truths as 1 and 0, texts as of csv_cell.h.
    std::string csv() const;
    /// An object a row, with the columns as keys; numbers that are not finite are null.
    nlohmann::ordered_json json() const;
    /// Writes the CSV. Throws std::runtime_error in one line where the file cannot be written.
    void write(const std::filesystem::path& file) const;

  private:
    std::vector<std::string> columns_;
    std::vector<std::vector<nlohmann::ordered_json>> rows_;
};

template <typename Value>
nlohmann::ordered_json or_empty(const std::optional<Value>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace osteomill::study
