#include "render_client/volume/shaders/shader_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace osteomill {

namespace {

/// #line takes no name, and Mesa forgets the file number that it takes. So one number identifies a line:
/// thousands for the file, in the order of shader_files, and the line within it.
constexpr std::size_t most_lines = 1000;

std::size_t number_of(std::string_view name) {
    const auto files = shader_files();
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const ShaderFile& file) { return file.name == name; });
    if (found == files.end()) throw std::logic_error(fmt::format("no shader file is called '{}'", name));
    return static_cast<std::size_t>(found - files.begin()) + 1;
}

std::size_t end_of_digits(std::string_view text, std::size_t from) {
    return std::min(text.find_first_not_of("0123456789", from), text.size());
}

/// "0:12" and "0(12)", as drivers write a line, by the file's name.
std::string with_file_names(std::string_view log) {
    constexpr std::size_t most_digits = 6;
    const auto files = shader_files();
    std::string named;
    for (std::size_t at = 0; at < log.size();) {
        const std::size_t source_end = end_of_digits(log, at);
        if (source_end == at) {
            named += log[at++];
            continue;
        }
        const bool has_line = source_end < log.size() && (log[source_end] == ':' || log[source_end] == '(');
        const std::size_t line_end = has_line ? end_of_digits(log, source_end + 1) : source_end;
        const std::string_view line =
            has_line ? log.substr(source_end + 1, line_end - source_end - 1) : std::string_view{};
        const std::size_t number =
            line.empty() || line.size() > most_digits ? 0 : std::stoul(std::string(line));
        if (number >= most_lines && number / most_lines <= files.size()) {
            named += fmt::format("{}{}{}", files[number / most_lines - 1].name, log[source_end],
                                 number % most_lines);
            at = line_end;
        } else {
            named += log.substr(at, source_end - at);
            at = source_end;
        }
    }
    return named;
}

}  // namespace

std::string shader_text(std::span<const std::string_view> names, const std::string& constants) {
    std::string text = "#version 330 core\n" + constants;
    for (const std::string_view name : names) {
        if (name.empty()) continue;
        const std::size_t number = number_of(name);
        text += fmt::format("#line {}\n{}", most_lines * number + 1, shader_files()[number - 1].text);
    }
    return text;
}

gl::Program make_program(const std::string& vertex_text, const std::string& fragment_text) {
    try {
        return gl::Program(vertex_text, fragment_text);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(with_file_names(error.what()));
    }
}

gl::Program make_program(const ProgramFiles& files) {
    return make_program(shader_text({&files.vertex, 1}), shader_text(files.fragment));
}

}  // namespace osteomill
