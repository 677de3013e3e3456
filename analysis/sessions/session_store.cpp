#include "analysis/sessions/session_store.h"

#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/files/atomic_file.h"
#include "common/files/input_file.h"

namespace osteomill::study {

SessionStore::SessionStore(std::filesystem::path file, std::string version)
    : file_(std::move(file)), version_(std::move(version)) {
    try {
        const auto json = nlohmann::json::parse(read_text(file_, json_kind));
        if (json.at("version") == version_) json.at("sessions").get_to(kept_);
    } catch (const std::exception&) {
        kept_.clear();
    }
}

std::optional<SessionRecord> SessionStore::find(const std::string& digest) const {
    const auto kept = kept_.find(digest);
    return kept == kept_.end() ? std::nullopt : std::optional(kept->second);
}

void SessionStore::write() const {
    const nlohmann::json json{{"version", version_}, {"sessions", kept_}};
    write_atomic_file(file_, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                      Link::replace);
}

}  // namespace osteomill::study
