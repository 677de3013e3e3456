// Text of a TOML file and the table it holds. Before a text is parsed, it is checked for anything on which
// toml++ crashes: toml++ nests a table for every dot of a key, and frees them by recursion; and it assumes
// that a name follows "[[".
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "common/scene/scene_change.h"
#include "common/scene/scene_file.h"

namespace osteomill {

/// Keys are written with two or three parts, values with two or three brackets.
inline constexpr int most_toml_key_parts = 32;
inline constexpr int most_toml_brackets = 32;
inline constexpr std::size_t most_toml_bytes = 1u << 20;

/// Error of a text that is no TOML, in contrast to one that is too large or too deep.
class NotToml : public SceneError {
  public:
    using SceneError::SceneError;
};

/// Throws NotToml, with `name` and the line, for a text that is no TOML; also with both, SceneError for a
/// text of more than most_toml_bytes, a key of more than most_toml_key_parts, and brackets (lists and inline
/// tables) deeper than most_toml_brackets.
toml::table parse_toml(std::string_view text, const std::string& name);

/// A file's text. Throws SceneError if it does not exist, is no regular file (a pipe, a device), or is larger
/// than most_toml_bytes. `what` names its kind in the message: "a scene file".
std::string read_toml_text(const std::filesystem::path& path, const char* what);

/// A string as TOML writes it, in quotes; reads back as the same bytes.
std::string toml_quoted(std::string_view text);

/// The table's reader checks whether the key exists. Throws SceneError, without file and line, if the path to
/// the key leads through a value, or through a list without an entry of that name.
void apply(const SceneChange& change, toml::table& scene);

}  // namespace osteomill
