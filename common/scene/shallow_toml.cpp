#include "common/scene/shallow_toml.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/files/input_file.h"
#include "common/scene/scene_file.h"

namespace osteomill {

namespace {

/// Goes over a text and knows what of it is a string or a comment.
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
                return;
            case '=':
            case ',':
                parts_ = 1;
                return;
            case '[':
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

    void skip_string(char quote) {
        const std::string three(3, quote);
        const bool is_long = text_.substr(at_, 3) == three;
        at_ += is_long ? 3 : 1;
        while (at_ < text_.size()) {
            const char letter = text_[at_];
            if (letter == '\n') {
                // A short string ends with its line, which the parser complains of.
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
};

}  // namespace

void require_shallow_toml(std::string_view text, const std::string& name) {
    if (text.size() > most_toml_bytes)
        throw SceneError(fmt::format("{}: {} bytes are more than the {} that are read", name, text.size(),
                                     most_toml_bytes));
    Skimmer(text, name).run();
}

std::string read_toml_text(const std::filesystem::path& path, const char* what) {
    try {
        return read_text(path, {.what = what, .most_bytes = most_toml_bytes});
    } catch (const std::runtime_error& error) {
        throw SceneError(error.what());
    }
}

}  // namespace osteomill
