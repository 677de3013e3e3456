#include "common/scene/toml_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/files/input_file.h"
#include "common/text/foreign_text.h"

namespace osteomill {

namespace {

bool is_letter_or_digit(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// Walks over a text and tells strings and comments from the rest.
class Skimmer {
  public:
    Skimmer(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    void run() {
        while (at_ < text_.size()) {
            const char letter = text_[at_];
            if (letter == '"' || letter == '\'') {
                skip_string(letter);
                continue;
            }
            if (letter == '#') at_ = std::min(text_.find('\n', at_), text_.size());
            if (at_ == text_.size()) return;
            look_at(text_[at_++]);
        }
    }

  private:
    void look_at(char letter) {
        switch (letter) {
            case '\n':
                ++line_;
                parts_ = 1;
                in_value_ = false;
                return;
            case '=':
                in_value_ = true;
                parts_ = 1;
                return;
            case ',':
                parts_ = 1;
                return;
            case '[':
                if (brackets_ == 0 && !in_value_) require_name_of_table();
                [[fallthrough]];
            case '{':
                parts_ = 1;
                if (++brackets_ > most_toml_brackets)
                    fail(fmt::format("more than {} brackets within one another", most_toml_brackets));
                return;
            case ']':
            case '}':
                if (brackets_ > 0) --brackets_;
                return;
            case '.':
                if (++parts_ > most_toml_key_parts)
                    fail(fmt::format("a key of more than {} parts", most_toml_key_parts));
                return;
            default:
                return;
        }
    }

    /// Behind the first bracket of a table's header.
    void require_name_of_table() const {
        std::size_t at = text_.find_first_not_of(" \t", at_);
        if (at == at_ && at < text_.size() && text_[at] == '[') at = text_.find_first_not_of(" \t", at + 1);
        if (at == std::string_view::npos) return;
        const char first = text_[at];
        const bool begins_name =
            is_letter_or_digit(first) || std::string_view("_-\"'").find(first) != std::string_view::npos;
        if (!begins_name)
            throw NotToml(
                fmt::format("{}:{}: not TOML: a table's name is missing behind its bracket", name_, line_));
    }

    void skip_string(char quote) {
        const std::string three(3, quote);
        const bool is_long = text_.substr(at_, 3) == three;
        at_ += is_long ? 3 : 1;
        while (at_ < text_.size()) {
            const char letter = text_[at_];
            if (letter == '\n') {
                // A short string ends with its line; the parser reports that.
                if (!is_long) return;
                ++line_;
            }
            if (letter == '\\' && quote == '"' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
                at_ += 2;
                continue;
            }
            if (letter == quote && (!is_long || text_.substr(at_, 3) == three)) {
                at_ += is_long ? 3 : 1;
                // A long string may end with one or two quotes of its own.
                for (int i = 0; is_long && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i) ++at_;
                return;
            }
            ++at_;
        }
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw SceneError(fmt::format("{}:{}: {}", name_, line_, reason));
    }

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    int line_ = 1;
    int parts_ = 1;
    int brackets_ = 0;
    bool in_value_ = false;  ///< behind the '=' of this line
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name) {
    if (text.size() > most_toml_bytes)
        throw SceneError(fmt::format("{}: {} bytes are more than the {} that are read", name, text.size(),
                                     most_toml_bytes));
    if (begins_as_utf16(text)) throw SceneError(name + ": is text in UTF-16; save it as UTF-8");
    Skimmer(text, name).run();
    try {
        return toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        throw NotToml(
            fmt::format("{}:{}: not TOML: {}", name, error.source().begin.line, error.description()));
    }
}

std::string read_toml_text(const std::filesystem::path& path, const char* what) {
    try {
        return read_text(path, {.what = what, .most_bytes = most_toml_bytes});
    } catch (const std::runtime_error& error) {
        throw SceneError(error.what());
    }
}

std::string toml_quoted(std::string_view text) {
    std::string quoted = "\"";
    for (const char letter : text) {
        const auto code = static_cast<unsigned char>(letter);
        if (code < 0x20 || code == 0x7f)
            quoted += fmt::format("\\u{:04x}", code);
        else if (letter == '"' || letter == '\\')
            quoted += {'\\', letter};
        else
            quoted += letter;
    }
    return quoted + '"';
}

}  // namespace osteomill
