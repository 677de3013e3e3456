// The cases that can be started on this machine: those built in, and the folders that a person has imported.
#pragma once

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/rating.h"

namespace osteomill {

/// Pictures of the built-in cases for their cards on the start page, as PNG files in the program.
struct CasePicture {
    std::string_view name;  ///< the case's
    std::span<const std::uint8_t> png;
};

/// Those in the folder case_pictures.
std::span<const CasePicture> case_pictures();

struct ShelvedCase {
    std::string name;
    std::string argument;  ///< for haptic_server --case
    bool is_built_in = false;
    std::string description{};      ///< a sentence, or the error in its scene
    std::string protected_names{};  ///< names of its protected tissues, "pulp, nerve canal"; empty: none
    std::string marks{};            ///< marks_in_words()

    bool operator==(const ShelvedCase&) const = default;
};

/// The user's, where cases and reports go unless an option says otherwise: $HOME/osteomill, or "osteomill"
/// here.
std::filesystem::path home_of_cases();

/// The built-in ones, then every folder of `folder` with a case.toml, by name. A folder that is not there has
/// none.
std::vector<ShelvedCase> cases_in(const std::filesystem::path& folder);

/// The marks that a session must reach, in the window's language: "at most 10 min, at most 3 N"; empty if no
/// mark is set.
std::string marks_in_words(const PassMarks& marks);

/// Why a case cannot have this name, in one line; empty if it can: a name of a file in any language, no
/// dot first, no blank at its ends, none like it in `folder`.
std::string wrong_with_name(const std::string& name, const std::filesystem::path& folder);

/// The report folder of a session that begins at `began`: named by case, trainee and local time, in
/// `reports`. Names as as_file_name makes them.
std::filesystem::path report_folder(const std::filesystem::path& reports, const std::string& case_name,
                                    const std::string& trainee, std::time_t began);

/// A folder of home_of_cases(), or of its replacement; made if it does not exist. Why nothing can be kept in
/// it, in one line with the remedy; empty: all is well.
std::string make_folder_at_home(const std::filesystem::path& folder);

}  // namespace osteomill
