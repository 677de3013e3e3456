#include "studies/stability/map/case_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "studies/stability/map/map_text.h"

namespace osteomill::study {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kind = "osteomill stability";

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw std::runtime_error(file.string() + ": " + what);
}

/// Up to the last end of a line: what follows was torn off by a kill.
std::string whole_lines_of(const std::filesystem::path& file) {
    std::string text = read_text(file, json_kind);
    const std::size_t last_end = text.rfind('\n');
    text.resize(last_end == std::string::npos ? 0 : last_end + 1);
    return text;
}

std::string header_line(const MapSelection& selection, const std::vector<MapPoint>& points,
                        const Shard& shard) {
    return ordered_json{{"map", kind},
                        {"fingerprint", fingerprint_of(points)},
                        {"cases", points.size()},
                        {"shard", shard.number},
                        {"of", shard.of},
                        {"selection", json_of(selection)}}
        .dump();
}

std::string case_line(std::size_t index, const MapOutcome& outcome) {
    ordered_json line{{"case", index}};
    line.update(json_of(outcome));
    return line.dump();
}

std::optional<CaseFile> header_of(const std::string& line) {
    try {
        const json header = json::parse(line);
        if (header.at("map") != kind) return std::nullopt;
        return CaseFile{.fingerprint = header.at("fingerprint").get<std::string>(),
                        .selection = selection_of(header.at("selection")),
                        .shard = {header.at("shard").get<std::size_t>(), header.at("of").get<std::size_t>()}};
    } catch (const json::exception&) {
    } catch (const std::invalid_argument&) {
    }
    return std::nullopt;
}

CaseFile parse(const std::string& text, const std::filesystem::path& file) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    std::optional<CaseFile> found = header_of(line);
    if (!found) fail(file, "its first line is not that of a file of cases of the stability map");
    for (int number = 2; std::getline(lines, line); ++number) {
        try {
            const json value = json::parse(line);
            const auto index = value.at("case").get<std::size_t>();
            if (!found->outcomes.emplace(index, outcome_of(value)).second)
                fail(file, fmt::format("line {}: case {} is there twice", number, index));
        } catch (const json::exception& error) {
            fail(file, fmt::format("line {} is no case: {}", number, error.what()));
        }
    }
    return std::move(*found);
}

}  // namespace

std::filesystem::path case_file_of(const Shard& shard, const std::filesystem::path& folder) {
    return folder / fmt::format("cases-{}-of-{}.jsonl", shard.number, shard.of);
}

CaseFile read_case_file(const std::filesystem::path& file) {
    return parse(whole_lines_of(file), file);
}

CaseFileWriter::CaseFileWriter(const std::filesystem::path& file, const MapSelection& selection,
                               const std::vector<MapPoint>& points, const Shard& shard)
    : file_(file),
      descriptor_(
          ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666)) {
    if (descriptor_ < 0) fail(file_, std::string("cannot be written: ") + std::strerror(errno));
    try {
        // A file system without locks lets everyone in: then it is the caller who starts a part only once.
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
            fail(file_, "another process is writing it");
        take_up(fingerprint_of(points), shard);
        if (std::filesystem::file_size(file_) == 0) write_line(header_line(selection, points, shard));
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

CaseFileWriter::~CaseFileWriter() {
    ::close(descriptor_);
}

void CaseFileWriter::take_up(const std::string& fingerprint, const Shard& shard) {
    const std::string text = whole_lines_of(file_);
    if (!text.empty()) {
        CaseFile found = parse(text, file_);
        if (found.fingerprint != fingerprint || found.shard != shard)
            fail(file_,
                 fmt::format("holds cases of another list (fingerprint {}, part {}/{}; wanted {}, {}/{}): "
                             "give another --out or remove it",
                             found.fingerprint, found.shard.number, found.shard.of, fingerprint, shard.number,
                             shard.of));
        done_before_ = std::move(found.outcomes);
    }
    if (::ftruncate(descriptor_, static_cast<off_t>(text.size())) != 0)
        fail(file_, std::string("cannot be cut after its last whole line: ") + std::strerror(errno));
}

void CaseFileWriter::append(std::size_t index, const MapOutcome& outcome) {
    write_line(case_line(index, outcome));
}

void CaseFileWriter::write_line(const std::string& line) {
    const std::string text = line + '\n';
    if (::write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        fail(file_, std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace osteomill::study
