#include "analysis/output/chart.h"

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string_view>

namespace osteomill::study {

namespace {

/// One word for a shell, whatever is in it.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

constexpr int shell_found_no_program = 127;

/// gnuplot ends well on a full disk, too.
void require_whole(const std::filesystem::path& chart) {
    constexpr std::string_view end = "</svg>";
    std::ifstream in(chart, std::ios::binary);
    constexpr std::streamsize last_bytes = 16;  // line breaks may follow
    std::string last(last_bytes, '\0');
    in.seekg(-last_bytes, std::ios::end).read(last.data(), last_bytes);
    if (in && last.find(end) != std::string::npos) return;
    std::error_code ignored;
    std::filesystem::remove(chart, ignored);
    throw std::runtime_error(chart.string() + ": gnuplot could not write all of it: is the disk full?");
}

}  // namespace

void draw_chart(const std::filesystem::path& scripts, const std::string& name,
                const std::filesystem::path& folder) {
    const std::filesystem::path script = scripts / (name + ".gp");
    if (!std::filesystem::exists(script)) throw std::runtime_error(script.string() + ": is not there");
    const std::string command = "gnuplot -e " + quoted("folder=\"" + folder.string() + "\"") + ' ' +
                                quoted(script.string()) + " 2>&1";
    FILE* const said = ::popen(command.c_str(), "r");
    if (said == nullptr) throw std::runtime_error("gnuplot cannot be started");
    std::string last_line;
    std::array<char, 1024> line{};
    while (std::fgets(line.data(), static_cast<int>(line.size()), said) != nullptr) {
        const std::string text(line.data(), std::strcspn(line.data(), "\n"));
        if (!text.empty()) last_line = text;
    }
    const int status = ::pclose(said);
    if (WIFEXITED(status) && WEXITSTATUS(status) == shell_found_no_program)
        throw std::runtime_error("gnuplot is not installed (package gnuplot-nox): the tables are in " +
                                 folder.string() + ", the charts are not");
    if (status != 0) throw std::runtime_error(script.string() + ": gnuplot failed: " + last_line);
    require_whole(folder / (name + ".svg"));
}

void require_charts() {
    chart_scripts();
    const int status = std::system("command -v gnuplot >/dev/null 2>&1");
    if (status != 0)
        throw std::runtime_error(
            "gnuplot, which draws the charts, is not installed (package gnuplot-nox): nothing was begun");
}

std::filesystem::path chart_scripts() {
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    return folder_with_scripts(program.parent_path() / "share/osteomill/charts", OSTEOMILL_CHART_SCRIPTS);
}

std::filesystem::path folder_with_scripts(const std::filesystem::path& installed,
                                          const std::filesystem::path& beside_sources) {
    // What every script loads.
    for (const std::filesystem::path& folder : {installed, beside_sources})
        if (std::filesystem::exists(folder / "style.gp")) return folder;
    throw std::runtime_error("the scripts of the charts are neither in " + installed.string() + " nor in " +
                             beside_sources.string());
}

}  // namespace osteomill::study
