// How long bone_import takes for each scan of the folder OSTEOMILL_SCANS, and how much memory at its peak.
// Prints; asserts nothing.
//
//     import_benchmark [SPACING_MM]
//
// Of each file and folder a bone at 0.5 mm, unless said otherwise, of what is above 300 HU.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace {

struct Cost {
    int status = 0;
    double seconds = 0.0;
    double peak_mb = 0.0;
};

Cost cost_of_import(const std::filesystem::path& scan, const std::filesystem::path& bone,
                    const std::string& spacing_mm) {
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child == 0) {
        if (std::freopen("/dev/null", "w", stderr) == nullptr) ::_exit(126);
        ::execl(BONE_IMPORT, BONE_IMPORT, scan.c_str(), bone.c_str(), "--spacing-mm", spacing_mm.c_str(),
                "--threshold-hu", "300", nullptr);
        ::_exit(127);
    }
    Cost cost;
    rusage used{};
    ::wait4(child, &cost.status, 0, &used);
    cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    cost.peak_mb = static_cast<double>(used.ru_maxrss) * 1024.0 / 1e6;
    return cost;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string spacing_mm = argc > 1 ? argv[1] : "0.5";
    const char* folder = std::getenv("OSTEOMILL_SCANS");
    if (folder == nullptr) {
        fmt::print(stderr, "import_benchmark: set OSTEOMILL_SCANS to a folder of scans\n");
        return 2;
    }
    std::vector<std::filesystem::path> scans(std::filesystem::directory_iterator(folder), {});
    std::sort(scans.begin(), scans.end());
    const osteomill::testing::TemporaryFolder made;
    fmt::print("{:<24} {:>8} {:>8}   at {} mm\n", "scan", "s", "peak MB", spacing_mm);
    for (const std::filesystem::path& scan : scans) {
        const Cost cost = cost_of_import(scan, made / "bone.nrrd", spacing_mm);
        if (cost.status == 0)
            fmt::print("{:<24} {:>8.1f} {:>8.0f}\n", scan.filename().string(), cost.seconds, cost.peak_mb);
        else
            fmt::print("{:<24} refused\n", scan.filename().string());
    }
}
