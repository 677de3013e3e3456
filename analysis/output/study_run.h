// A run of a study: the cases that it plans and their outcomes, the folder that it fills, what it says.
//
//     StudyRun run(out, surroundings);
//     const auto planned = run.plan(motions, name_of, measure);
//     if (!run.perform()) return;  // a part: its cases are in its file
//     run.write(table_of(planned.outcomes()), "motions");
//
// Cases are independent, and named, so that they may run on several threads, or in parts on several machines,
// and go on where they were stopped (--jobs, --shard, --merge). Outcomes go through a file of JSON lines in
// every case (cases/part_file.h): what is written of them does not depend on where they ran.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

#include "analysis/output/surroundings.h"
#include "analysis/output/table.h"

namespace osteomill::study {

/// Cases of a StudyRun. `Outcome` has to_json and from_json as of nlohmann::json.
template <typename Outcome>
class PlannedCases {
  public:
    /// In the order of the cases; once they were performed.
    std::vector<Outcome> outcomes() const {
        std::vector<Outcome> own;
        for (std::size_t i = first_; i < first_ + count_; ++i)
            own.push_back(all_->at(i).template get<Outcome>());
        return own;
    }

  private:
    friend class StudyRun;
    PlannedCases(std::shared_ptr<const std::vector<nlohmann::json>> all, std::size_t first, std::size_t count)
        : all_(std::move(all)), first_(first), count_(count) {}

    std::shared_ptr<const std::vector<nlohmann::json>> all_;
    std::size_t first_;
    std::size_t count_;
};

class StudyRun {
  public:
    /// Makes the folder `out` if it is not there; `surroundings` outlive the run. What writes throws
    /// std::runtime_error in one line naming what cannot be written, this as well.
    StudyRun(std::filesystem::path out, const StudySurroundings& surroundings);
    /// Outcomes that were kept in case the run is stopped are no longer needed where it was not.
    ~StudyRun();
    StudyRun(const StudyRun&) = delete;
    StudyRun& operator=(const StudyRun&) = delete;

    const std::filesystem::path& out() const { return out_; }

    /// Cases to perform: `name_of(case)` tells which it is, in words; `run(case)` is thread-safe, and gives
    /// the same for the same case, but for times that it measures.
    template <typename Case, typename Name, typename Run>
    auto plan(const std::vector<Case>& cases, Name&& name_of, const Run& run) {
        using Outcome = std::decay_t<std::invoke_result_t<const Run&, const Case&>>;
        const std::size_t first = cases_.size();
        for (const Case& c : cases)
            cases_.push_back({name_of(c), [c, run] { return nlohmann::json(run(c)); }});
        return PlannedCases<Outcome>(outcomes_, first, cases.size());
    }

    /// Runs what is planned and not done yet, or takes it from parts that are joined. False for a part of
    /// several, whose outcomes are not all there. Throws std::runtime_error naming the case that fails, and
    /// as PartFileWriter and JoinedParts do.
    bool perform();

    /// Nothing is to be made of the outcomes: the next run in this folder may be of something else.
    void forget_outcomes();

    /// A line.
    template <typename... Arguments>
    void say(fmt::format_string<Arguments...> format, Arguments&&... arguments) const {
        surroundings_.said << fmt::format(format, std::forward<Arguments>(arguments)...) << std::endl;
    }

    /// Files of the folder: NAME.csv, NAME.json, NAME.svg (chart.h).
    void write(const Table& table, const std::string& name) const;
    void write(const nlohmann::ordered_json& json, const std::string& name) const;
    void draw(std::initializer_list<const char*> charts) const;

  private:
    struct NamedCase {
        std::string name;
        std::function<nlohmann::json()> run;
    };
    void perform_part(const std::vector<std::string>& names, const std::filesystem::path& file);

    std::filesystem::path out_;
    const StudySurroundings& surroundings_;
    std::vector<NamedCase> cases_{};
    std::shared_ptr<std::vector<nlohmann::json>> outcomes_ =
        std::make_shared<std::vector<nlohmann::json>>();  ///< shared with what plan() gave
    std::filesystem::path whole_file_{};                  ///< of outcomes, once all are in it
    int failures_before_ = std::uncaught_exceptions();
};

/// Throws as require_charts() where gnuplot is not there; a part of several needs none.
void require_charts_of(const StudySurroundings& surroundings);

}  // namespace osteomill::study
