#include "analysis/output/cases/part_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "common/text/foreign_json.h"

namespace osteomill::study {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* not_a_number = "number nan";
constexpr const char* above_all = "number inf";
constexpr const char* below_all = "number -inf";

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

void spell_out(json& value) {
    if (value.is_structured()) {
        for (json& element : value) spell_out(element);
    } else if (value.is_number_float() && !std::isfinite(value.get<double>())) {
        const auto number = value.get<double>();
        value = std::isnan(number) ? not_a_number : number > 0.0 ? above_all : below_all;
    }
}

void take_back(json& value) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (value.is_structured()) {
        for (json& element : value) take_back(element);
    } else if (value == not_a_number) {
        value = std::numeric_limits<double>::quiet_NaN();
    } else if (value == above_all || value == below_all) {
        value = value == above_all ? infinity : -infinity;
    }
}

std::string header_line(const PartHeader& header) {
    return ordered_json{{"study", header.command},
                        {"program", header.program},
                        {"cases", header.cases},
                        {"shard", header.shard.number},
                        {"of", header.shard.of}}
        .dump();
}

std::optional<PartHeader> header_of(const std::string& line, const std::filesystem::path& file) {
    try {
        const json header = parse_foreign_json(line, file.string());
        return PartHeader{
            .command = header.at("study").get<std::vector<std::string>>(),
            .program = header.at("program").get<std::string>(),
            .cases = header.at("cases").get<std::string>(),
            .shard = {header.at("shard").get<std::size_t>(), header.at("of").get<std::size_t>()}};
    } catch (const json::exception&) {
        return std::nullopt;
    }
}

PartFile parse(const std::string& text, const std::filesystem::path& file) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    const std::optional<PartHeader> header = header_of(line, file);
    if (!header) fail(file, "its first line is not that of a file of a study's cases");
    PartFile found{*header};
    for (int number = 2; std::getline(lines, line); ++number) {
        try {
            json value = parse_foreign_json(line, fmt::format("{}: line {}", file.string(), number));
            const auto index = value.at("case").get<std::size_t>();
            json& outcome = value.at("outcome");
            take_back(outcome);
            if (!found.outcomes.emplace(index, std::move(outcome)).second)
                fail(file, fmt::format("line {}: case {} is there twice", number, index));
        } catch (const json::exception& error) {
            fail(file, fmt::format("line {} is no case: {}", number, error.what()));
        }
    }
    return found;
}

}  // namespace

std::filesystem::path part_file_of(const Shard& shard, const std::filesystem::path& folder) {
    return folder / fmt::format("cases-{}-of-{}.jsonl", shard.number, shard.of);
}

PartFile read_part_file(const std::filesystem::path& file) {
    return parse(whole_lines_of(file), file);
}

PartFileWriter::PartFileWriter(const std::filesystem::path& file, const PartHeader& header)
    : file_(file),
      descriptor_(
          ::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666)) {
    if (descriptor_ < 0) fail(file_, std::string("cannot be written: ") + std::strerror(errno));
    try {
        // A file system without locks lets everyone in: then it is the caller who starts a part only once.
        if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
            fail(file_, "another process is writing it");
        take_up(header);
        if (std::filesystem::file_size(file_) == 0) write_line(header_line(header));
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
}

PartFileWriter::~PartFileWriter() {
    ::close(descriptor_);
}

void PartFileWriter::take_up(const PartHeader& header) {
    const std::string text = whole_lines_of(file_);
    if (!text.empty()) {
        PartFile found = parse(text, file_);
        if (found.header.program != header.program)
            fail(file_, "holds cases of another build of this program: give another --out or remove it");
        if (found.header != header)
            fail(file_,
                 fmt::format("holds cases of another list ({}, part {}/{}): give another --out or remove it",
                             fmt::join(found.header.command, " "), found.header.shard.number,
                             found.header.shard.of));
        done_before_ = std::move(found.outcomes);
    }
    if (::ftruncate(descriptor_, static_cast<off_t>(text.size())) != 0)
        fail(file_, std::string("cannot be cut after its last whole line: ") + std::strerror(errno));
}

void PartFileWriter::append(std::size_t index, const json& outcome) {
    json spelled = outcome;
    spell_out(spelled);
    write_line(ordered_json{{"case", index}, {"outcome", std::move(spelled)}}.dump());
}

void PartFileWriter::write_line(const std::string& line) {
    const std::string text = line + '\n';
    for (std::string_view rest = text; !rest.empty();) {
        const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
        if (written < 0) fail(file_, std::string("cannot be written: ") + std::strerror(errno));
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
}

}  // namespace osteomill::study
