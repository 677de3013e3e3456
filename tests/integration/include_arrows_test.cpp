// The product's modules, and which may use which: every include points downward.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace osteomill::testing {
namespace {

using ::testing::IsEmpty;
using Folders = std::vector<std::string>;

struct Module {
    std::string folder;
    Folders uses;  // beside itself and the generated messages of proto/
};

/// A file belongs to the first module whose folder holds it.
const std::vector<Module>& modules() {
    static const std::vector<Module> all{
        {"common/", {}},
        {"bridge/", {}},
        {"simulation/", {"common/bone/", "common/scene/"}},
        {"devices/", {"common/", "bridge/", "simulation/device/", "simulation/exchange/"}},
        {"imaging/case/", {"common/", "imaging/", "simulation/force_models/"}},
        {"imaging/", {"common/"}},
        {"analysis/", {"common/", "simulation/", "imaging/"}},
        {"haptic_server/", {"common/", "bridge/", "simulation/", "devices/", "imaging/", "analysis/"}},
        {"render_client/", {"common/"}},
        {"slicer/", {"common/", "render_client/link/"}},
        // The pictures of the module of Python are a library of their own: its core knows no OpenGL. They
        // include its sessions, and describe them as a server would to a client.
        {"python/render/",
         {"common/", "haptic_server/streaming/live_session.h", "imaging/case/structures.h",
          "python/module/arrays.h", "python/module/exceptions.h", "python/module/released_lock.h",
          "python/module/stepped_session.h", "render_client/dataset/", "render_client/volume/"}},
        // Kernels of the package's studies.
        {"python/studies/",
         {"common/", "python/module/arrays.h", "python/module/loaded_case.h", "bridge/", "simulation/",
          "devices/", "imaging/", "analysis/", "haptic_server/", "render_client/", "studies/"}},
        {"python/",
         {"common/", "simulation/", "devices/simulated/", "imaging/", "analysis/", "haptic_server/"}},
        {"studies/",
         {"common/", "bridge/", "simulation/", "devices/", "imaging/", "analysis/", "haptic_server/",
          "render_client/"}},
    };
    return all;
}

bool is_in(const std::string& file, const std::string& folder) {
    return file.starts_with(folder);
}

bool may_use(const Module& module, const std::string& file) {
    if (is_in(file, module.folder) || is_in(file, "osteomill/")) return true;
    return std::any_of(module.uses.begin(), module.uses.end(),
                       [&](const std::string& folder) { return is_in(file, folder); });
}

/// The includes of our own files, as they are written.
std::vector<std::string> includes_of(const std::filesystem::path& file) {
    static const std::regex include(R"re(^#include "([^"]+)")re");
    std::vector<std::string> found;
    std::ifstream in(file);
    std::smatch match;
    for (std::string line; std::getline(in, line);)
        if (std::regex_search(line, match, include)) found.push_back(match[1]);
    return found;
}

TEST(IncludeArrows, PointDownward) {
    const std::filesystem::path root(REPOSITORY);
    Folders wrong;
    int includes = 0;
    for (const Module& module : modules()) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / module.folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".cpp" && extension != ".h") continue;
            const std::string file = std::filesystem::relative(entry.path(), root).string();
            // A file of a narrower module is judged there.
            const auto own = std::find_if(modules().begin(), modules().end(),
                                          [&](const Module& one) { return is_in(file, one.folder); });
            if (&*own != &module) continue;
            for (const std::string& included : includes_of(entry.path())) {
                if (included.find('/') == std::string::npos || included.starts_with("..")) continue;
                ++includes;
                if (!may_use(module, included)) wrong.push_back(file + " includes " + included);
            }
        }
    }
    EXPECT_THAT(wrong, IsEmpty());
    EXPECT_GT(includes, 1000) << "the modules were not found";
}

}  // namespace
}  // namespace osteomill::testing
