// Settings of the window that are kept from one run to the next, in a file at the user's home.
#pragma once

#include <filesystem>
#include <string>

#include "render_client/ui/panels/theme.h"

namespace osteomill {

struct KeptSettings {
    ThemeName theme = ThemeName::dark;
    bool sound = false;  ///< whether the burr is heard
    bool warns = true;   ///< a tone, near a protected structure
    bool details_shown = false;
    bool tour_seen = false;

    bool operator==(const KeptSettings&) const = default;
};

class SettingsFile {
  public:
    /// Reads it. Settings that it leaves out have their defaults. If anything in it is wrong, all have, and
    /// the file is never overwritten: no setting is worth an error, and a person's file is worth more than
    /// settings.
    explicit SettingsFile(std::filesystem::path file);

    const KeptSettings& settings() const { return settings_; }
    /// One line about an error in the file, its place, and the remedy; empty: none.
    const std::string& wrong() const { return wrong_; }
    /// Writes them, as a whole, if they are others than before. Returns one line about an error, once; else
    /// nothing.
    std::string keep(const KeptSettings& settings);

  private:
    std::filesystem::path file_;
    KeptSettings settings_{};
    std::string wrong_{};
    bool is_unwritable_ = false;
};

}  // namespace osteomill
