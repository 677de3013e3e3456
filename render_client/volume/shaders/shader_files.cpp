#include "render_client/volume/shaders/shader_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace osteomill {

namespace {

/// The number by which a file goes in #line, which takes no name; 0 is what stands before all files.
std::size_t number_of(std::string_view name) {
    const auto files = shader_files();
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const ShaderFile& file) { return file.name == name; });
    if (found == files.end()) throw std::logic_error(fmt::format("no shader file is called '{}'", name));
    return static_cast<std::size_t>(found - files.begin()) + 1;
}

/// "7:12" and "7(12)" at the beginning of a line, as drivers write a file's number and a line of it.
std::string with_file_names(const std::string& log) {
    static const std::regex place(R"((^|[\n ])(\d+)(:|\()(\d+)\b)");
    const auto files = shader_files();
    std::string named;
    std::sregex_iterator match(log.begin(), log.end(), place);
    auto end = log.begin();
    for (; match != std::sregex_iterator(); ++match) {
        const std::smatch& found = *match;
        const std::size_t number = std::min<std::size_t>(std::stoul(found[2]), files.size() + 1);
        named.append(end, found[0].first);
        if (number >= 1 && number <= files.size())
            named += fmt::format("{}{}{}{}", found[1].str(), files[number - 1].name, found[3].str(),
                                 found[4].str());
        else
            named += found[0].str();
        end = found[0].second;
    }
    return named.append(end, log.end());
}

}  // namespace

std::string shader_text(std::span<const std::string_view> names, const std::string& constants) {
    std::string text = "#version 330 core\n" + constants;
    for (const std::string_view name : names) {
        if (name.empty()) continue;
        const std::size_t number = number_of(name);
        text += fmt::format("#line 1 {}\n{}", number, shader_files()[number - 1].text);
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
