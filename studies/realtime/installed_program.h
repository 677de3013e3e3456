// Programs that a machine may or may not have.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace osteomill::study {

/// Where PATH has a program of this name; nothing where it has none that this process may run.
std::optional<std::filesystem::path> installed_program(const std::string& name);

}  // namespace osteomill::study
