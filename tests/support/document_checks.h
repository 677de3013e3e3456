// Checks for faults of a document that nobody notices: links that lead nowhere, paths that are no
// more, commands whose options no program has.
#pragma once

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace osteomill::testing {

/// A Markdown file as the checks see it.
struct Document {
    std::filesystem::path file;  ///< relative to the repository
    std::string text;
};

/// The Markdown files of the repository's root and of docs/, sorted.
std::vector<Document> read_documents(const std::filesystem::path& repository);

/// The anchors that GitHub gives to the headings of a document, without #.
std::set<std::string> anchors_of(const std::string& text);

/// Each finding is a line "FILE: what is wrong".
using Findings = std::vector<std::string>;

/// Links to files or anchors that are not there. Those to the web are not followed.
Findings dead_links(const Document& document, const std::filesystem::path& repository);

/// Paths below one of the repository's folders, and names of sources (.h, .cpp, .proto), that a document
/// names in `code` or in a block of bash and that do not exist.
Findings dead_paths(const Document& document, const std::filesystem::path& repository);

/// A call of one of our programs, as a document shows it.
struct ShownCommand {
    std::string program;                 ///< without its folder
    std::vector<std::string> arguments;  ///< up to the next command of the line
};

/// The calls of programs in build/release/bin in the document's blocks of bash.
std::vector<ShownCommand> shown_commands(const std::string& text);

/// A program's output for --help; `subcommand` may be empty. Throws std::runtime_error if there is no such
/// program.
using Help = std::function<std::string(const std::string& program, const std::string& subcommand)>;

/// Programs that do not exist, and options that their help does not name.
Findings bad_commands(const Document& document, const Help& help);

}  // namespace osteomill::testing
