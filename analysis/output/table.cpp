#include "analysis/output/table.h"

#include <fmt/format.h>

#include <stdexcept>

#include "analysis/output/output_files.h"
#include "common/text/csv_cell.h"

namespace osteomill::study {

namespace {

std::string cell_of(const nlohmann::ordered_json& value) {
    if (value.is_null()) return "";
    if (value.is_boolean()) return value.get<bool>() ? "1" : "0";
    if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
    if (value.is_string()) return csv_cell(value.get_ref<const std::string&>());
    return value.dump();
}

template <typename Cells, typename CellOf>
std::string line_of(const Cells& cells, CellOf&& text_of) {
    std::string line;
    for (const auto& cell : cells) line += text_of(cell) + ',';
    line.back() = '\n';
    return line;
}

}  // namespace

void Table::add(std::vector<nlohmann::ordered_json> row) {
    if (row.size() != columns_.size())
        throw std::logic_error(
            fmt::format("a row of {} values in a table of {} columns", row.size(), columns_.size()));
    rows_.push_back(std::move(row));
}

std::string Table::csv() const {
    std::string csv = line_of(columns_, csv_cell);
    for (const auto& row : rows_) csv += line_of(row, cell_of);
    return csv;
}

nlohmann::ordered_json Table::json() const {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const auto& row : rows_) {
        nlohmann::ordered_json object;
        for (std::size_t i = 0; i < row.size(); ++i) object[columns_[i]] = row[i];
        json.push_back(std::move(object));
    }
    return json;
}

void Table::write(const std::filesystem::path& file) const {
    write_text(csv(), file);
}

}  // namespace osteomill::study
