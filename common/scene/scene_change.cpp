#include "common/scene/scene_change.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/scene/nearest_name.h"
#include "common/scene/scene_file.h"
#include "common/scene/toml_text.h"

namespace osteomill {

namespace {

/// Splits off the part before the first dot.
std::string_view take_part(std::string_view& key) {
    const std::size_t dot = key.find('.');
    const std::string_view part = key.substr(0, dot);
    key = dot == std::string_view::npos ? std::string_view() : key.substr(dot + 1);
    return part;
}

/// The table of a list whose name the rest of the key begins with; a name may hold dots ("1.5 mm").
toml::table& take_named(toml::array& list, std::string_view& key, std::string_view list_name) {
    toml::table* found = nullptr;
    std::size_t length = 0;
    std::vector<std::string> names;
    for (toml::node& entry : list) {
        toml::table* table = entry.as_table();
        const std::optional<std::string> name =
            table ? (*table)["name"].value<std::string>() : std::optional<std::string>();
        if (!name) continue;
        names.push_back(*name);
        if (key.size() > name->size() && key.starts_with(*name) && key[name->size()] == '.' &&
            name->size() >= length) {
            found = table;
            length = name->size();
        }
    }
    if (found == nullptr) {
        const std::string written(key.substr(0, key.rfind('.')));
        const auto meant = nearest_name(written, names);
        throw SceneError(fmt::format("'{}' names none of [[{}]]; {}there are: {}", written, list_name,
                                     meant ? fmt::format("did you mean '{}'? ", *meant) : "",
                                     fmt::join(names, ", ")));
    }
    key.remove_prefix(length + 1);
    return *found;
}

/// Read as the value of a TOML file; anything else is a text.
void set(toml::table& table, std::string_view key, const std::string& value, bool is_text) {
    if (is_text) {
        table.insert_or_assign(key, value);
        return;
    }
    try {
        toml::table parsed = parse_toml("value = " + value, fmt::format("'{}'", key));
        if (parsed.size() == 1) {
            table.insert_or_assign(key, std::move(*parsed.get("value")));
            return;
        }
    } catch (const NotToml&) {
    }
    table.insert_or_assign(key, value);
}

}  // namespace

SceneChange parse_scene_change(std::string_view text) {
    const std::size_t at = text.find('=');
    if (at == std::string_view::npos || at == 0)
        throw std::invalid_argument(
            fmt::format("'{}' is no KEY=VALUE, such as wall_friction=0.3 or device.scale=0.5", text));
    return {.key = std::string(text.substr(0, at)), .value = std::string(text.substr(at + 1))};
}

void apply(const SceneChange& change, toml::table& scene) {
    if (std::ranges::count(change.key, '.') >= most_toml_key_parts)
        throw SceneError(fmt::format("a key has no more than {} parts", most_toml_key_parts));
    toml::table* table = &scene;
    std::string_view rest = change.key;
    for (;;) {
        const std::string_view part = take_part(rest);
        if (part.empty()) throw SceneError(fmt::format("'{}' is no key", change.key));
        if (rest.empty()) return set(*table, part, change.value, change.is_text);
        toml::node* node = table->get(part);
        if (node == nullptr) node = &table->insert_or_assign(part, toml::table()).first->second;
        if (toml::array* list = node->as_array(); list != nullptr && list->is_array_of_tables()) {
            table = &take_named(*list, rest, part);
        } else if (node->is_table()) {
            table = node->as_table();
        } else {
            throw SceneError(fmt::format("'{}' is no table, and has no key '{}'", part, rest));
        }
    }
}

}  // namespace osteomill
