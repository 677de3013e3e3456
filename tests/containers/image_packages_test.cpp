// The images of docker/ name the packages that their programs run on. They are built only where Docker runs;
// whether a name is missing shows here, too.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/child_process.h"

namespace osteomill::testing {
namespace {

std::string out_of(const std::string& command) {
    const Finished run = run_program({"/bin/sh", "-c", command});
    EXPECT_EQ(run.status, 0) << command << ": " << run.err;
    return run.out;
}

/// Words, without what a list of packages has about them: commas, versions, architectures.
std::set<std::string> words_of(std::string text) {
    for (char& c : text)
        if (c == ',' || c == '|' || c == '\\' || c == ':' || c == '(' || c == ')') c = ' ';
    std::istringstream in(text);
    return {std::istream_iterator<std::string>(in), {}};
}

/// The packages that hold the libraries which a program names. What the loader takes in beyond these is
/// their packages' affair.
std::set<std::string> packages_for(const std::filesystem::path& program) {
    return words_of(out_of("dpkg-query -S $(objdump -p '" + program.string() +
                           "' | sed -n 's|^ *NEEDED *|*/lib/*-linux-gnu/|p') | cut -d: -f1"));
}

/// What a Dockerfile names, and what these depend on. Not each of its words is a package.
std::set<std::string> packages_of(const std::filesystem::path& dockerfile) {
    std::ifstream in(dockerfile);
    std::set<std::string> packages = words_of({std::istreambuf_iterator<char>(in), {}});
    std::string libraries;
    for (const std::string& word : packages)
        if (word.starts_with("lib")) libraries += " '" + word + "'";
    packages.merge(words_of(out_of("dpkg-query -W -f '${Depends} '" + libraries + " 2>/dev/null || true")));
    return packages;
}

void expect_that_holds(const std::filesystem::path& dockerfile, const std::vector<std::string>& programs) {
    const std::set<std::string> there = packages_of(dockerfile);
    for (const std::string& program : programs) {
        const std::set<std::string> needed = packages_for(std::filesystem::path(PROGRAMS) / program);
        EXPECT_GT(needed.size(), 3U);
        for (const std::string& package : needed)
            EXPECT_TRUE(there.contains(package)) << program << " needs " << package << ", which "
                                                 << dockerfile.filename() << " does not install";
    }
}

TEST(ImagePackages, HoldWhatTheProgramsNeed) {
    if (run_program({"/bin/sh", "-c", "command -v objdump && command -v dpkg-query"}).status != 0)
        GTEST_SKIP() << "objdump or dpkg-query is not there: is this Debian?";
    const std::filesystem::path docker(DOCKER_FOLDER);
    expect_that_holds(docker / "server.Dockerfile", {"haptic_server", "packet_replay"});
    expect_that_holds(docker / "client.Dockerfile", {"render_client"});
}

}  // namespace
}  // namespace osteomill::testing
