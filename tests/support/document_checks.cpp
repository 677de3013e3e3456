#include "tests/support/document_checks.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace osteomill::testing {

namespace fs = std::filesystem;

namespace {

/// A document's lines, sorted by kind.
struct Parts {
    std::vector<std::string> prose;
    std::vector<std::string> bash;
};

Parts parts_of(const std::string& text) {
    Parts parts;
    bool is_in_block = false;
    bool is_bash = false;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first != std::string::npos && line.compare(first, 3, "```") == 0) {
            const std::string language = line.substr(first + 3);
            is_bash = !is_in_block && (language == "bash" || language == "sh");
            is_in_block = !is_in_block;
        } else if (!is_in_block) {
            parts.prose.push_back(line);
        } else if (is_bash) {
            parts.bash.push_back(line);
        }
    }
    return parts;
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (std::sregex_iterator match(text.begin(), text.end(), pattern); match != std::sregex_iterator();
         ++match)
        found.push_back((*match)[1]);
    return found;
}

const std::regex code_span("`([^`]+)`");

std::string without_code(const std::string& line) {
    return std::regex_replace(line, code_span, "``");
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream stream(line);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// The commands of blocks of bash: comments gone, lines that go on joined, one command each.
std::vector<std::vector<std::string>> commands_of(const std::vector<std::string>& lines) {
    std::string joined;
    for (const std::string& line : lines) {
        const std::string code = std::regex_replace(line, std::regex("(^|\\s)#.*$"), "");
        const bool goes_on = !code.empty() && code.back() == '\\';
        joined += goes_on ? code.substr(0, code.size() - 1) + ' ' : code + '\n';
    }
    std::vector<std::vector<std::string>> commands;
    std::istringstream split(std::regex_replace(joined, std::regex("&&|\\|\\||[|;&]"), "\n"));
    for (std::string line; std::getline(split, line);)
        if (std::vector<std::string> words = words_of(line); !words.empty())
            commands.push_back(std::move(words));
    return commands;
}

/// Whether a user makes this folder: builds, and the programs' outputs.
bool is_made(const std::string& folder) {
    return folder == "build" || folder == "out";
}

bool is_below_folder_of(const std::string& path, const fs::path& repository) {
    const std::size_t slash = path.find('/');
    if (slash == std::string::npos || slash == 0 || is_made(path.substr(0, slash))) return false;
    return fs::is_directory(repository / path.substr(0, slash)) && path.front() != '.';
}

/// Names of all sources, wherever they are.
std::set<std::string> source_names(const fs::path& repository) {
    std::set<std::string> names;
    for (const auto& top : fs::directory_iterator(repository)) {
        const std::string name = top.path().filename();
        if (!top.is_directory() || is_made(name) || name.front() == '.') continue;
        for (const auto& entry : fs::recursive_directory_iterator(top)) names.insert(entry.path().filename());
    }
    return names;
}

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

std::string finding(const Document& document, const std::string& what) {
    return document.file.string() + ": " + what;
}

/// Whether a help text has an option, as a whole word.
bool names_option(const std::string& help, const std::string& option) {
    for (std::size_t at = help.find(option); at != std::string::npos; at = help.find(option, at + 1)) {
        const char next = at + option.size() < help.size() ? help[at + option.size()] : ' ';
        if (std::isalnum(static_cast<unsigned char>(next)) == 0 && next != '-' && next != '_') return true;
    }
    return false;
}

}  // namespace

std::vector<Document> read_documents(const fs::path& repository) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(repository)) files.push_back(entry.path());
    for (const auto& entry : fs::recursive_directory_iterator(repository / "docs"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<Document> documents;
    for (const fs::path& file : files) {
        if (file.extension() == ".md") documents.push_back({fs::relative(file, repository), text_of(file)});
    }
    return documents;
}

std::set<std::string> anchors_of(const std::string& text) {
    std::set<std::string> anchors;
    for (const std::string& line : parts_of(text).prose) {
        const std::size_t level = line.find_first_not_of('#');
        if (level == 0 || level == std::string::npos || line[level] != ' ') continue;
        std::string anchor;
        for (const char letter : line.substr(level + 1)) {
            const auto byte = static_cast<unsigned char>(letter);
            if (letter == ' ') anchor += '-';
            if (std::isalnum(byte) != 0 || byte >= 0x80 || letter == '-' || letter == '_')
                anchor += static_cast<char>(std::tolower(byte));
        }
        std::string unique = anchor;
        for (int count = 1; anchors.contains(unique); ++count) unique = anchor + '-' + std::to_string(count);
        anchors.insert(unique);
    }
    return anchors;
}

Findings dead_links(const Document& document, const fs::path& repository) {
    static const std::regex link("\\]\\(([^)\\s]+)\\)");
    Findings findings;
    for (const std::string& line : parts_of(document.text).prose) {
        for (const std::string& target : matches(without_code(line), link)) {
            if (target.find("://") != std::string::npos || target.compare(0, 7, "mailto:") == 0) continue;
            const std::size_t hash = target.find('#');
            const std::string path = target.substr(0, hash);
            const fs::path file = repository / document.file.parent_path() / path;
            if (!path.empty() && !fs::exists(file)) {
                findings.push_back(finding(document, "a link leads to " + target + ", which is not there"));
                continue;
            }
            if (hash == std::string::npos) continue;
            const std::string text = path.empty() ? document.text : text_of(file);
            if (!anchors_of(text).contains(target.substr(hash + 1)))
                findings.push_back(
                    finding(document, "a link leads to " + target + ", and there is no such heading"));
        }
    }
    return findings;
}

Findings dead_paths(const Document& document, const fs::path& repository) {
    static const std::regex plain("[A-Za-z0-9_./-]+");
    static const std::regex source("[A-Za-z0-9_]+\\.(h|cpp|proto)");
    static const std::regex stands_for_a_name("(.*/)?[A-Z]+(/.*)?");  // tests/unit/FOLDER
    const Parts parts = parts_of(document.text);
    std::vector<std::string> named;
    for (const std::string& line : parts.prose)
        for (const std::string& code : matches(line, code_span))
            for (const std::string& word : words_of(code)) named.push_back(word);
    for (const std::vector<std::string>& command : commands_of(parts.bash))
        for (const std::string& word : command) named.push_back(word);

    Findings findings;
    const std::set<std::string> sources = source_names(repository);
    for (std::string path : named) {
        if (path.compare(0, 2, "./") == 0) path.erase(0, 2);
        if (!std::regex_match(path, plain) || std::regex_match(path, stands_for_a_name)) continue;
        const bool is_missing = is_below_folder_of(path, repository)
                                    ? !fs::exists(repository / path)
                                    : std::regex_match(path, source) && !sources.contains(path);
        if (is_missing) findings.push_back(finding(document, "it names " + path + ", which is not there"));
    }
    return findings;
}

std::vector<ShownCommand> shown_commands(const std::string& text) {
    static const std::string folder = "build/release/bin/";
    std::vector<ShownCommand> shown;
    for (const std::vector<std::string>& words : commands_of(parts_of(text).bash)) {
        const auto program = std::find_if(words.begin(), words.end(),
                                          [](const std::string& word) { return word.rfind(folder, 0) == 0; });
        // `sudo setcap ... PROGRAM` and the like do something to a program instead of calling it.
        if (program == words.end() || program->size() == folder.size()) continue;
        shown.push_back({program->substr(folder.size()), {program + 1, words.end()}});
    }
    return shown;
}

Findings bad_commands(const Document& document, const Help& help) {
    Findings findings;
    for (const ShownCommand& command : shown_commands(document.text)) {
        const bool has_subcommand = command.program == "osteomill_study" && !command.arguments.empty() &&
                                    command.arguments.front().front() != '-';
        try {
            const std::string text = help(command.program, has_subcommand ? command.arguments.front() : "");
            for (const std::string& argument : command.arguments) {
                const std::string option = argument.substr(0, argument.find('='));
                if (option.rfind("--", 0) == 0 && !names_option(text, option))
                    findings.push_back(finding(document, command.program + " has no option " + option));
            }
        } catch (const std::runtime_error& error) {
            findings.push_back(finding(document, error.what()));
        }
    }
    return findings;
}

}  // namespace osteomill::testing
