#include "render_client/volume/shaders/shader_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace osteomill {

namespace {

/// #line takes no name, and Mesa forgets the file's number that it does take. So a line is known by one
/// number: thousands for the file, in the order of shader_files, and the line within it.
constexpr std::size_t most_lines = 1000;

std::size_t number_of(std::string_view name) {
    const auto files = shader_files();
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const ShaderFile& file) { return file.name == name; });
    if (found == files.end()) throw std::logic_error(fmt::format("no shader file is called '{}'", name));
    return static_cast<std::size_t>(found - files.begin()) + 1;
}

/// "0:12" and "0(12)", as drivers write a line, by the file's name.
std::string with_file_names(const std::string& log) {
    const std::regex place(R"(\b\d+(:|\()(\d{4,6})\b)");
    const auto files = shader_files();
    std::string named;
    auto copied = log.begin();
    for (std::sregex_iterator match(log.begin(), log.end(), place); match != std::sregex_iterator();
         ++match) {
        const std::smatch& found = *match;
        const std::size_t number = std::stoul(found[2]);
        if (number / most_lines > files.size()) continue;
        named.append(copied, found[0].first);
        named +=
            fmt::format("{}{}{}", files[number / most_lines - 1].name, found[1].str(), number % most_lines);
        copied = found[0].second;
    }
    return named.append(copied, log.end());
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
