#include "analysis/output/study_run.h"

#include <stdexcept>
#include <utility>

#include "analysis/output/cases/part_file.h"
#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "analysis/output/sweep.h"
#include "common/program/progress.h"

namespace osteomill::study {

StudyRun::StudyRun(std::filesystem::path out, const StudySurroundings& surroundings)
    : out_(std::move(out)), surroundings_(surroundings) {
    make_folder(out_);
}

StudyRun::~StudyRun() {
    if (std::uncaught_exceptions() == failures_before_) forget_outcomes();
}

void StudyRun::forget_outcomes() {
    std::error_code ignored;
    if (!whole_file_.empty()) std::filesystem::remove(whole_file_, ignored);
}

bool StudyRun::perform() {
    std::vector<std::string> names;
    for (const NamedCase& c : cases_) names.push_back(c.name);
    if (surroundings_.parts.joined) {
        *outcomes_ = surroundings_.parts.joined->outcomes(names);
        return true;
    }
    const Shard& shard = surroundings_.parts.shard;
    const std::filesystem::path file = part_file_of(shard, out_);
    perform_part(names, file);
    if (shard.of > 1) {
        say("part {} of {} is in {}; join the parts with --merge", shard.number, shard.of, file.string());
        return false;
    }
    const PartFile whole = read_part_file(file);
    outcomes_->resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) outcomes_->at(i) = whole.outcomes.at(i);
    whole_file_ = file;
    return true;
}

void StudyRun::perform_part(const std::vector<std::string>& names, const std::filesystem::path& file) {
    const StudyParts& parts = surroundings_.parts;
    PartFileWriter writer(file, {.command = parts.command,
                                 .program = fingerprint_of_program(),
                                 .cases = fingerprint_of(names),
                                 .shard = parts.shard});
    std::vector<std::size_t> to_do = cases_of(parts.shard, names);
    const std::size_t all = to_do.size();
    std::erase_if(to_do, [&](std::size_t index) { return writer.done_before().contains(index); });
    const std::size_t done_before = all - to_do.size();
    if (done_before > 0) say("{} of {} cases are done in {}", done_before, all, file.string());

    ProgressLine line(surroundings_.progress, surroundings_.is_terminal, "cases");
    std::size_t done = done_before;
    const auto report = [&] { line.report(static_cast<double>(done) / static_cast<double>(all)); };
    if (all > 0) report();
    const auto run = [&](std::size_t i) {
        const NamedCase& c = cases_[to_do[i]];
        try {
            return c.run();
        } catch (const std::exception& error) {
            throw std::runtime_error("case '" + c.name + "': " + error.what());
        }
    };
    sweep(to_do.size(), parts.jobs, run, [&](std::size_t i, const nlohmann::json& outcome) {
        writer.append(to_do[i], outcome);
        ++done;
        report();
    });
}

void StudyRun::write(const Table& table, const std::string& name) const {
    table.write(out_ / (name + ".csv"));
}

void StudyRun::write(const nlohmann::ordered_json& json, const std::string& name) const {
    write_json(json, out_ / (name + ".json"));
}

void StudyRun::draw(std::initializer_list<const char*> charts) const {
    const std::filesystem::path scripts = chart_scripts();
    for (const char* const chart : charts) draw_chart(scripts, chart, out_);
}

void require_charts_of(const StudySurroundings& surroundings) {
    if (surroundings.parts.shard.of == 1) require_charts();
}

}  // namespace osteomill::study
