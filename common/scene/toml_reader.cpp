#include "common/scene/toml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/bone/patient_space.h"
#include "common/scene/nearest_name.h"
#include "common/scene/scene_file.h"
#include "common/text/foreign_text.h"

namespace osteomill {

TomlReader::TomlReader(const toml::table& table, std::string file, std::string table_name)
    : table_(&table), file_(std::move(file)), table_name_(std::move(table_name)) {}

const toml::node* TomlReader::take(std::string_view key) {
    known_keys_.emplace_back(key);
    return table_->get(key);
}

void TomlReader::fail(std::string_view key, const std::string& message) const {
    const toml::node* node = table_->get(key);
    const auto line = (node ? node->source() : table_->source()).begin.line;
    throw SceneError(fmt::format("{}:{}: {}", file_, line, message));
}

std::optional<double> TomlReader::finite_number(const toml::node& node) {
    if (!node.is_number()) return std::nullopt;
    const std::optional<double> value = node.value<double>();
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> TomlReader::number(std::string_view key, const AllowedRange& range) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    const std::optional<double> value = finite_number(*node);
    if (!value) fail(key, fmt::format("'{}' must be a finite number", key));
    if (*value < range.low || *value > range.high)
        fail(key, fmt::format("'{}' is {}; it must lie within {} to {}", key, *value, range.low, range.high));
    return value;
}

std::optional<std::int64_t> TomlReader::whole_number(std::string_view key, std::int64_t low,
                                                     std::int64_t high) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    if (!node->is_integer()) fail(key, fmt::format("'{}' must be a whole number", key));
    const std::int64_t value = **node->as_integer();
    if (value < low || value > high)
        fail(key, fmt::format("'{}' is {}; it must lie within {} to {}", key, value, low, high));
    return value;
}

void TomlReader::rpm(std::string_view key, double& rev_per_s, double usual_rev_per_s,
                     const AllowedRange& range_rpm) {
    constexpr double seconds_per_minute = 60.0;
    const std::optional<double> rpm = number(key, range_rpm);
    rev_per_s = rpm ? *rpm / seconds_per_minute : usual_rev_per_s;
}

void TomlReader::needed_number(std::string_view key, double& value, const AllowedRange& range) {
    value = required(*this, key, number(key, range));
}

const std::string& TomlReader::plain(std::string_view key, const std::string& text) const {
    if (const auto why = why_not_plain(text)) fail(key, fmt::format("'{}' {}", key, *why));
    return text;
}

std::optional<std::string> TomlReader::text(std::string_view key) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    if (!node->is_string()) fail(key, fmt::format("'{}' must be a text in quotes", key));
    return plain(key, **node->as_string());
}

std::optional<std::vector<std::string>> TomlReader::texts(std::string_view key) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    std::vector<std::string> result;
    const toml::array* list = node->as_array();
    if (list)
        for (const toml::node& entry : *list)
            if (const auto value = entry.value<std::string>()) result.push_back(plain(key, *value));
    if (!list || result.size() != list->size()) fail(key, fmt::format("'{}' must be a list of texts", key));
    return result;
}

std::optional<std::size_t> TomlReader::choice(std::string_view key, const std::vector<std::string>& choices) {
    const std::optional<std::string> value = text(key);
    if (!value) return std::nullopt;
    const auto found = std::find(choices.begin(), choices.end(), *value);
    if (found == choices.end())
        fail(key, fmt::format("'{}' is \"{}\"; choose one of: {}", key, one_line(*value),
                              fmt::join(choices, ", ")));
    return static_cast<std::size_t>(found - choices.begin());
}

std::optional<bool> TomlReader::truth(std::string_view key) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    if (!node->is_boolean()) fail(key, fmt::format("'{}' must be true or false", key));
    return **node->as_boolean();
}

std::optional<glm::dvec3> TomlReader::vector(std::string_view key) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    const toml::array* values = node->as_array();
    glm::dvec3 result(0.0);
    bool good = values && values->size() == 3;
    for (int axis = 0; good && axis < 3; ++axis) {
        const std::optional<double> value = finite_number((*values)[static_cast<std::size_t>(axis)]);
        good = value.has_value();
        if (good) result[axis] = *value;
    }
    if (!good) fail(key, fmt::format("'{}' must be three finite numbers, like [0.0, 0.0, 1.0]", key));
    return result;
}

std::optional<glm::dvec3> TomlReader::place(std::string_view key) {
    const std::optional<glm::dvec3> value = vector(key);
    if (value && !is_place(*value))
        fail(key, fmt::format("'{}' lies more than {} mm from the origin", key, farthest_place_mm));
    return value;
}

std::optional<glm::dvec3> TomlReader::direction(std::string_view key) {
    const std::optional<glm::dvec3> value = vector(key);
    if (!value) return std::nullopt;
    const std::optional<glm::dvec3> direction = unit_direction(*value);
    if (!direction) fail(key, fmt::format("'{}' has no length; give a direction, about 1 long", key));
    return direction;
}

std::optional<std::vector<std::vector<double>>> TomlReader::rows(std::string_view key, std::size_t width) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    const auto refuse = [&] {
        fail(key, fmt::format("'{}' must be a list of lists of {} finite numbers each", key, width));
    };
    const toml::array* list = node->as_array();
    if (!list) refuse();
    std::vector<std::vector<double>> result;
    for (const toml::node& entry : *list) {
        const toml::array* row = entry.as_array();
        if (!row || row->size() != width) refuse();
        std::vector<double> values;
        for (const toml::node& cell : *row) {
            const std::optional<double> value = finite_number(cell);
            if (!value) refuse();
            values.push_back(*value);
        }
        result.push_back(std::move(values));
    }
    return result;
}

std::optional<TomlReader> TomlReader::table(std::string_view key) {
    const toml::node* node = take(key);
    if (!node) return std::nullopt;
    if (!node->is_table()) fail(key, fmt::format("'{}' must be a table, written [{}]", key, key));
    return TomlReader(*node->as_table(), file_, fmt::format("[{}]", key));
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) {
    const toml::node* node = take(key);
    if (!node) return {};
    if (!node->is_array_of_tables())
        fail(key, fmt::format("'{}' must be a list of tables, each written [[{}]]", key, key));
    std::vector<TomlReader> result;
    for (const toml::node& entry : *node->as_array())
        result.emplace_back(*entry.as_table(), file_, fmt::format("[[{}]]", key));
    return result;
}

void TomlReader::fail_missing(std::string_view key) const {
    std::vector<std::string> unread;
    for (const auto& [other, node] : *table_)
        if (std::find(known_keys_.begin(), known_keys_.end(), other.str()) == known_keys_.end())
            unread.emplace_back(other.str());
    const std::optional<std::string> misspelt = nearest_name(key, unread);
    if (misspelt)
        fail(*misspelt,
             fmt::format("key '{}' is missing in {}; '{}' looks like it", key, table_name_, *misspelt));
    fail(key, fmt::format("key '{}' is missing in {}", key, table_name_));
}

void TomlReader::refuse_other_keys() const {
    for (const auto& [key, node] : *table_) {
        if (std::find(known_keys_.begin(), known_keys_.end(), key.str()) != known_keys_.end()) continue;
        const std::optional<std::string> meant = nearest_name(key.str(), known_keys_);
        const std::string guess = meant ? fmt::format("did you mean '{}'? ", *meant) : "";
        throw SceneError(fmt::format("{}:{}: unknown key '{}' in {}; {}choose one of: {}", file_,
                                     key.source().begin.line, one_line(key.str()), table_name_, guess,
                                     fmt::join(known_keys_, ", ")));
    }
}

}  // namespace osteomill
