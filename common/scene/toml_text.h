// Text of a TOML file and the table it holds. A text is skimmed before it is parsed, for what toml++ crashes
// on: it makes a table within a table for every dot of a key, and calls itself to take them down again; and
// it takes for granted that a name begins behind "[[".
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "common/scene/scene_file.h"

namespace osteomill {

/// Keys are written with two or three parts, values with two or three brackets.
inline constexpr int most_toml_key_parts = 32;
inline constexpr int most_toml_brackets = 32;
inline constexpr std::size_t most_toml_bytes = 1u << 20;

/// Of a text that is no TOML, in contrast to one that is too much of it.
class NotToml : public SceneError {
  public:
    using SceneError::SceneError;
};

/// Throws NotToml, with `name` and the line, for what is no TOML; SceneError, likewise, for a text of more
/// than most_toml_bytes, a key of more than most_toml_key_parts, and brackets (lists and inline tables)
/// deeper than most_toml_brackets.
toml::table parse_toml(std::string_view text, const std::string& name);

/// A file's text. Throws SceneError for what is not there or no file (a pipe, a device), and for what is
/// larger than most_toml_bytes. `what` it is goes into the message: "a scene
/// file".
std::string read_toml_text(const std::filesystem::path& path, const char* what);

}  // namespace osteomill
