// Strict reading of one TOML table: every key requested is checked for type and range, every other key is an
// error. Messages carry file and line.
#pragma once

#include <toml++/toml.h>

#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace osteomill {

/// Closed range that a number must lie in.
struct AllowedRange {
    double low = -std::numeric_limits<double>::max();
    double high = std::numeric_limits<double>::max();
};

class TomlReader {
  public:
    /// `table_name` is the table's name in messages, for instance "[burrs]". The table must outlive the
    /// reader.
    TomlReader(const toml::table& table, std::string file, std::string table_name);

    /// Each takes a key: absent keys give nullopt; a wrong type, a value out of range, or a text
    /// with control characters throws SceneError.
    std::optional<double> number(std::string_view key, const AllowedRange& range = {});
    std::optional<std::int64_t> whole_number(std::string_view key, std::int64_t low, std::int64_t high);
    std::optional<std::string> text(std::string_view key);
    /// A list of texts.
    std::optional<std::vector<std::string>> texts(std::string_view key);
    /// A text out of `choices`; gives its index.
    std::optional<std::size_t> choice(std::string_view key, const std::vector<std::string>& choices);
    std::optional<bool> truth(std::string_view key);
    std::optional<glm::dvec3> vector(std::string_view key);
    /// In patient space, mm: within farthest_place_mm of the origin (patient_space.h).
    std::optional<glm::dvec3> place(std::string_view key);
    /// Made of unit length.
    std::optional<glm::dvec3> direction(std::string_view key);
    /// A list of lists of `width` numbers each.
    std::optional<std::vector<std::vector<double>>> rows(std::string_view key, std::size_t width);

    /// As above into `value`, which is `usual` if the key is absent: for the keys of scene_keys.h.
    void number(std::string_view key, double& value, double usual, const AllowedRange& range) {
        value = number(key, range).value_or(usual);
    }
    void whole_number(std::string_view key, int& value, int usual, int low, int high) {
        value = static_cast<int>(whole_number(key, low, high).value_or(usual));
    }
    /// In the file revolutions per minute.
    void rpm(std::string_view key, double& rev_per_s, double usual_rev_per_s, const AllowedRange& range_rpm);
    void truth(std::string_view key, bool& value, bool usual) { value = truth(key).value_or(usual); }
    void vector(std::string_view key, glm::dvec3& value, const glm::dvec3& usual) {
        value = vector(key).value_or(usual);
    }
    void place(std::string_view key, glm::dvec3& value, const glm::dvec3& usual) {
        value = place(key).value_or(usual);
    }
    void direction(std::string_view key, glm::dvec3& value, const glm::dvec3& usual) {
        value = direction(key).value_or(usual);
    }
    /// Empty if absent.
    void text(std::string_view key, std::string& value) { value = text(key).value_or(""); }
    /// One of an enumeration, by its place among `names`.
    template <typename Choice, typename Names>
    void choice(std::string_view key, Choice& value, Choice usual, const Names& names) {
        const auto index = choice(key, std::vector<std::string>(names.begin(), names.end()));
        value = index ? static_cast<Choice>(*index) : usual;
    }
    /// Throws SceneError if the key is absent.
    void needed_number(std::string_view key, double& value, const AllowedRange& range);

    std::optional<TomlReader> table(std::string_view key);
    std::vector<TomlReader> tables(std::string_view key);

    /// Throws for the first key of the table that was never requested, naming the requested ones.
    void refuse_other_keys() const;

    /// Throws SceneError at the line of a key (or of the table, if it has no such key).
    [[noreturn]] void fail(std::string_view key, const std::string& message) const;

    /// Throws SceneError for a required key that is absent: at the line of a key that may be its misspelling,
    /// else at the line of the table.
    [[noreturn]] void fail_missing(std::string_view key) const;

  private:
    const toml::node* take(std::string_view key);
    const std::string& plain(std::string_view key, const std::string& text) const;
    static std::optional<double> finite_number(const toml::node& node);

    const toml::table* table_;
    std::string file_;
    std::string table_name_;
    std::vector<std::string> known_keys_;
};

/// The value that was read for a key; throws SceneError if it was absent.
template <typename T>
T required(const TomlReader& reader, std::string_view key, std::optional<T> value) {
    if (!value) reader.fail_missing(key);
    return *std::move(value);
}

}  // namespace osteomill
