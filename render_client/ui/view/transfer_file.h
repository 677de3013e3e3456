// Transfer function of bone as a file: its curve of colour and opacity (transfer_function.h), as TOML. A case
// keeps its own in `look.toml`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render_client/volume/transfer_function.h"

namespace osteomill {

/// None: tissues, or stiffness, in their own colours. Throws SceneError, in one line, for what is no such
/// file.
std::optional<TransferFunction> read_look(const std::filesystem::path& file);
std::optional<TransferFunction> parse_look(std::string_view text, const std::string& name_for_messages);

/// Reads back to the same.
std::string look_text(const std::optional<TransferFunction>& look);

/// Which file the look is read from and saved to, as sessions come and go.
class TransferFile {
  public:
    /// `file` is the user's and stays; empty: that of each case. `otherwise`: of a case that has none.
    TransferFile(std::filesystem::path file, std::optional<TransferFunction> otherwise)
        : file_(std::move(file)), is_users_(!file_.empty()), otherwise_(std::move(otherwise)) {}

    /// A session begins for which the look is in this file, if there is one. Returns its look where that is
    /// another file than before, and none where the file is the user's. Throws as read_look does; then the
    /// file is not to be written over, and save says so.
    std::optional<std::optional<TransferFunction>> open(const std::filesystem::path& file);
    bool has_file() const { return !file_.empty(); }
    /// Writes the file as a whole. Returns one line that says where it is, or what went wrong.
    std::string save(const std::optional<TransferFunction>& look) const;

  private:
    std::filesystem::path file_;
    bool is_users_;
    bool is_bad_ = false;
    std::optional<TransferFunction> otherwise_;
};

}  // namespace osteomill
