#include "common/files/distinct_files.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <tuple>

#include "common/files/atomic_file.h"
#include "common/files/inside_folder.h"
#include "common/files/session_file.h"

namespace osteomill {

namespace {

namespace fs = std::filesystem;

/// Links followed.
fs::path resolved(const fs::path& named) {
    const fs::path path = end_of_links(named);
    std::error_code failed;
    fs::path whole = fs::weakly_canonical(fs::absolute(path, failed), failed);
    return failed ? path.lexically_normal() : whole;
}

bool are_one(const fs::path& one, const fs::path& other) {
    std::error_code failed;
    const fs::file_status status = fs::status(one, failed);
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) return false;
        if (fs::equivalent(one, other, failed)) return true;
    }
    return resolved(one) == resolved(other);
}

bool is_folder_to_read(const NamedFile& file) {
    std::error_code failed;
    return !file.is_written && fs::is_directory(file.path, failed);
}

/// Calls `visit(entry)` for all below a folder until it says true; whether it did.
template <typename Visit>
bool any_below(const fs::path& folder, const Visit& visit) {
    std::error_code failed;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, failed);
    for (; !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed))
        if (visit(entry->path())) return true;
    return false;
}

/// An output in a folder that is read as input would become part of the input of the next run.
bool lies_in_what_is_read(const fs::path& written, const fs::path& folder) {
    std::error_code failed;
    if (fs::exists(written, failed) && !fs::is_regular_file(written, failed)) return false;
    if (lies_inside(written, folder)) return true;
    return fs::is_regular_file(written, failed) &&
           any_below(folder, [&](const fs::path& one) { return are_one(one, written); });
}

bool has_such_a_name(const fs::path& path, const NamedFile& written) {
    const fs::path within = resolved(path).lexically_relative(resolved(written.path));
    return !within.empty() && *within.begin() != ".." &&
           ::fnmatch(written.names.c_str(), within.c_str(), 0) == 0;
}

/// Whether a file is one of those that are written in a folder, also under a second name that it has there.
bool is_written_in(const NamedFile& written, const NamedFile& other) {
    if (has_such_a_name(other.path, written)) return true;
    std::error_code failed;
    if (!fs::is_regular_file(other.path, failed) || fs::hard_link_count(other.path, failed) < 2) return false;
    return any_below(written.path, [&](const fs::path& one) {
        return has_such_a_name(one, written) && are_one(one, other.path);
    });
}

[[noreturn]] void refuse_as_read(const NamedFile& written, const NamedFile& read) {
    throw std::invalid_argument(fmt::format("{} {}: lies in {}, {}, all of which is read; write it elsewhere",
                                            written.option, written.path.string(), read.option,
                                            read.path.string()));
}

[[noreturn]] void refuse_as_one(const NamedFile& one, const NamedFile& other) {
    throw std::invalid_argument(one.option + " and " + other.option + " are the same file, " +
                                other.path.string() + "; one would destroy the other");
}

/// `one` before `other` on the command line.
void require_distinct(const NamedFile& one, const NamedFile& other) {
    if (!one.is_written && !other.is_written) return;
    if ((!one.is_replaced_by.empty() && one.is_replaced_by == other.option) ||
        (!other.is_replaced_by.empty() && other.is_replaced_by == one.option))
        return;
    if (!one.names.empty() && !other.names.empty()) return;
    if (!one.names.empty() || !other.names.empty()) {
        const auto& [folder, file] = one.names.empty() ? std::tie(other, one) : std::tie(one, other);
        if (is_written_in(folder, file)) refuse_as_one(folder, file);
        if (is_folder_to_read(file) && lies_inside(folder.path, file.path)) refuse_as_read(folder, file);
        return;
    }
    if (are_one(one.path, other.path)) refuse_as_one(one, other);
    if (is_folder_to_read(one) && lies_in_what_is_read(other.path, one.path)) refuse_as_read(other, one);
    if (is_folder_to_read(other) && lies_in_what_is_read(one.path, other.path)) refuse_as_read(one, other);
    if ((one.is_written && are_one(part_of(resolved(one.path)), other.path)) ||
        (other.is_written && are_one(part_of(resolved(other.path)), one.path)))
        throw std::invalid_argument(one.option + " and " + other.option + ": " + one.path.string() + " and " +
                                    other.path.string() +
                                    " get in each other's way, as a file is called NAME.part.EXT "
                                    "while it is written; choose another name");
}

}  // namespace

std::vector<NamedFile> files_written_in(const std::string& option, const fs::path& folder,
                                        std::span<const char* const> names) {
    std::vector<NamedFile> files;
    for (const char* const name : names) files.push_back({.option = option, .path = folder, .names = name});
    return files;
}

void require_distinct(std::span<const NamedFile> files) {
    for (std::size_t i = 0; i < files.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) require_distinct(files[j], files[i]);
    for (const NamedFile& file : files)
        if (file.is_written && file.names.empty())
            if (const std::string why = why_no_target(file.path); !why.empty())
                throw std::invalid_argument(file.option + ": " + why);
}

}  // namespace osteomill
