// Every target on its seeds, and on these with a byte changed or cut off: the regression test of the findings
// of fuzzing, in every build, without clang.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <random>
#include <vector>

#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {
namespace {

struct Target {
    const char* name;
    void (*run)(Bytes);
    std::vector<std::filesystem::path> folders{};

    friend std::ostream& operator<<(std::ostream& out, const Target& target) { return out << target.name; }
};

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class FuzzSeeds : public ::testing::TestWithParam<Target> {
  protected:
    static std::vector<std::vector<std::uint8_t>> seeds() {
        std::vector<std::vector<std::uint8_t>> seeds;
        std::vector folders = GetParam().folders;
        folders.push_back(std::filesystem::path(REPOSITORY "/tests/fuzz/seeds") / GetParam().name);
        for (const auto& folder : folders)
            for (const auto& entry : std::filesystem::directory_iterator(folder))
                seeds.push_back(bytes_of(entry.path()));
        EXPECT_FALSE(seeds.empty());
        return seeds;
    }
    static void run(const std::vector<std::uint8_t>& input) { EXPECT_NO_THROW(GetParam().run(input)); }
};

TEST_P(FuzzSeeds, BreakNoInvariant) {
    for (const auto& seed : seeds()) run(seed);
}

TEST_P(FuzzSeeds, BreakNoneWhenTheyAreDamaged) {
    constexpr int changes_of_a_seed = 50;
    std::mt19937 random(17);
    for (const auto& seed : seeds())
        for (int i = 0; i < changes_of_a_seed && !seed.empty(); ++i) {
            auto damaged = seed;
            damaged[random() % damaged.size()] ^= static_cast<std::uint8_t>(1U << random() % 8);
            if (i % 5 == 0) damaged.resize(random() % damaged.size());
            run(damaged);
        }
}

INSTANTIATE_TEST_SUITE_P(
    Of, FuzzSeeds,
    ::testing::Values(Target{"frame_decoder", frame_decoder}, Target{"server_session", server_session},
                      Target{"client_session", client_session}, Target{"recording", recording},
                      Target{"scene", scene, {REPOSITORY "/scenes"}}, Target{"haply_state", haply_state},
                      Target{"nrrd_header", nrrd_header}, Target{"meta_image_header", meta_image_header},
                      Target{"nifti_header", nifti_header}, Target{"dicom_header", dicom_header},
                      Target{"dicom_segmentation", dicom_segmentation}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace osteomill::fuzz
