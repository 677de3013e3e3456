#include "analysis/output/repeated/repeated_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "common/files/input_file.h"
#include "common/files/table_line.h"
#include "common/text/foreign_json.h"
#include "common/text/words.h"

namespace osteomill::study {

namespace {

/// Cells of a file by column.
using Columns = std::map<std::string, std::vector<std::string>>;

Columns columns_of_csv(const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> names = quoted_cells(line, ',');
    Columns columns;
    while (std::getline(in, line)) {
        const std::vector<std::string> cells = quoted_cells(line, ',');
        for (std::size_t i = 0; i < std::min(cells.size(), names.size()); ++i)
            columns[names[i]].push_back(cells[i]);
    }
    return columns;
}

/// What stands at the same place of each element of a list is a column.
Columns columns_of_json(const std::string& text, const std::filesystem::path& file) {
    static const std::regex index("/[0-9]+");
    Columns columns;
    const nlohmann::json flat = parse_foreign_json(text, file.string()).flatten();
    for (const auto& [place, value] : flat.items())
        columns[std::regex_replace(place, index, "/*")].push_back(value.is_string() ? value.get<std::string>()
                                                                                    : value.dump());
    return columns;
}

Columns columns_of(const std::filesystem::path& file) {
    if (file.extension() == ".csv") return columns_of_csv(read_text(file, table_kind));
    try {
        return columns_of_json(read_text(file, json_kind), file);
    } catch (const nlohmann::json::exception&) {
        throw std::runtime_error(file.string() + ": is no JSON");
    }
}

/// In numbers; infinite where one of them is none, or not finite.
double distance(const std::string& a, const std::string& b) {
    if (a == b) return 0.0;
    const auto x = finite_number(a);
    const auto y = finite_number(b);
    if (!x || !y) return HUGE_VAL;
    return std::abs(*x - *y);
}

bool are_alike(const Columns& a, const Columns& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
        return x.first == y.first && x.second.size() == y.second.size();
    });
}

RepeatedColumn compare_column(const std::vector<std::string>& kept, const std::vector<std::string>& once,
                              const std::vector<std::string>& again) {
    RepeatedColumn found;
    for (std::size_t row = 0; row < kept.size(); ++row)
        if (const double apart = distance(once[row], again[row]); std::isfinite(apart))
            found.noise = std::max(found.noise, apart);
    for (std::size_t row = 0; row < kept.size(); ++row) {
        const double difference = std::min(distance(kept[row], once[row]), distance(kept[row], again[row]));
        if (difference <= noise_margin * found.noise) continue;
        ++found.differ;
        found.difference = std::max(found.difference, difference);
    }
    return found;
}

bool is_table(const std::filesystem::path& file) {
    return file.extension() == ".csv" || (file.extension() == ".json" && file.filename() != "manifest.json");
}

}  // namespace

RepeatedTables compare_tables(const std::filesystem::path& kept, const std::filesystem::path& once,
                              const std::filesystem::path& again) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(kept))
        if (is_table(entry.path())) files.push_back(entry.path().filename());
    std::ranges::sort(files);
    RepeatedTables result;
    for (const std::string& file : files) {
        if (!std::filesystem::exists(once / file) || !std::filesystem::exists(again / file)) {
            result.other.push_back(file + ": is not written any more");
            continue;
        }
        const Columns before = columns_of(kept / file);
        const Columns now = columns_of(once / file);
        const Columns then = columns_of(again / file);
        if (!are_alike(before, now) || !are_alike(now, then)) {
            result.other.push_back(file + ": has other rows or columns");
            continue;
        }
        for (const auto& [name, cells] : before) {
            ++result.columns;
            RepeatedColumn found = compare_column(cells, now.at(name), then.at(name));
            if (found.differ == 0) continue;
            found.name = fmt::format("{}: {}", file, name);
            result.different.push_back(std::move(found));
        }
    }
    return result;
}

}  // namespace osteomill::study
