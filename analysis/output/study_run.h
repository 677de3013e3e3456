// A run of a study: the folder that it fills, what it says, and how far it has come.
#pragma once

#include <fmt/format.h>

#include <exception>
#include <filesystem>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

#include "analysis/output/surroundings.h"
#include "analysis/output/table.h"
#include "common/program/progress.h"

namespace osteomill::study {

class StudyRun {
  public:
    /// `out` is there; `surroundings` outlive the run. What writes throws std::runtime_error in one line
    /// naming what cannot be written.
    StudyRun(std::filesystem::path out, const StudySurroundings& surroundings)
        : out_(std::move(out)), surroundings_(surroundings) {}

    const std::filesystem::path& out() const { return out_; }

    /// Does a part of the work with a bar of its own, which `work` moves by its one argument, a
    /// ReportProgress; the bar ends full.
    template <typename Work>
    auto chapter(const std::string& title, Work&& work) const {
        ProgressLine line(surroundings_.progress, surroundings_.is_terminal, title);
        const Finished finished{line};
        return work(line.reporter());
    }

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
    struct Finished {
        ProgressLine& line;
        int failures_before = std::uncaught_exceptions();
        ~Finished() {
            if (std::uncaught_exceptions() == failures_before) line.report(1.0);
        }
    };

    std::filesystem::path out_;
    const StudySurroundings& surroundings_;
};

}  // namespace osteomill::study
