#include "common/files/distinct_files.h"

#include <stdexcept>
#include <system_error>

#include "common/files/atomic_file.h"
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

}  // namespace

void require_distinct(std::span<const NamedFile> files) {
    for (std::size_t i = 0; i < files.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const NamedFile& one = files[j];
            const NamedFile& other = files[i];
            if (!one.is_written && !other.is_written) continue;
            if (are_one(one.path, other.path))
                throw std::invalid_argument(one.option + " and " + other.option + " are the same file, " +
                                            other.path.string() + "; one would destroy the other");
            if ((one.is_written && are_one(part_of(resolved(one.path)), other.path)) ||
                (other.is_written && are_one(part_of(resolved(other.path)), one.path)))
                throw std::invalid_argument(one.option + " and " + other.option + ": " + one.path.string() +
                                            " and " + other.path.string() +
                                            " get in each other's way, as a file is called NAME.part.EXT "
                                            "while it is written; choose another name");
        }
}

}  // namespace osteomill
