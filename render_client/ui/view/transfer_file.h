// Transfer function of bone as a file: its curve of colour and opacity (transfer_function.h), as TOML. A case
// keeps its own in `look.toml`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "render_client/volume/transfer_function.h"

namespace osteomill {

/// None: tissues, or stiffness, in their own colours. Throws SceneError, in one line, for any other file.
std::optional<TransferFunction> read_transfer(const std::filesystem::path& file);
std::optional<TransferFunction> parse_look(std::string_view text, const std::string& name_for_messages);

/// Reads back to the same.
std::string look_text(const std::optional<TransferFunction>& look);

/// The file from which the transfer function is read and to which it is saved, as sessions come and go.
class TransferFile {
  public:
    /// `file` is chosen by the user and stays; empty: each case's own. `otherwise`: for a case without one.
    TransferFile(std::filesystem::path file, std::optional<TransferFunction> otherwise)
        : file_(std::move(file)), is_users_(!file_.empty()), otherwise_(std::move(otherwise)) {}

    /// Begins a session whose transfer function is in this file, if there is one. Returns it if the file is
    /// another than before; nothing if the user chose the file. Throws as read_transfer does; the file then
    /// must not be overwritten, and save reports that.
    std::optional<std::optional<TransferFunction>> open(const std::filesystem::path& file);
    bool has_file() const { return !file_.empty(); }
    /// Writes the file as a whole. Returns one line with its place, or the error.
    std::string save(const std::optional<TransferFunction>& look) const;

  private:
    std::filesystem::path file_;
    bool is_users_;
    bool is_bad_ = false;
    std::optional<TransferFunction> otherwise_;
};

}  // namespace osteomill
