// Test with a folder of its own, in which programs leave their files.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/file_text.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::testing {

class FolderTest : public ::testing::Test {
  protected:
    std::string file(const std::string& name) const { return (folder_ / name).string(); }
    std::string text(const std::string& name) const { return text_of(folder_ / name); }
    nlohmann::json json(const std::string& name) const { return nlohmann::json::parse(text(name)); }

    TemporaryFolder folder_;
};

}  // namespace osteomill::testing
