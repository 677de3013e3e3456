#include "studies/realtime/realtime_options.h"

#include <CLI/CLI.hpp>
#include <memory>

#include "common/program/option_checks.h"
#include "studies/realtime/realtime_study.h"

namespace osteomill::study {

StudyCommand add_realtime(CLI::App& app) {
    const auto shared = std::make_shared<RealtimeStudyOptions>();
    RealtimeStudyOptions& options = *shared;
    options.out = "study/realtime";
    CLI::App* realtime = app.add_subcommand("realtime",
                                            "how late the haptic loop wakes and how long it takes, in turns "
                                            "with cyclictest; then under stress-ng");
    add_out(*realtime, options.out);
    CLI::Option* const duration =
        realtime
            ->add_option("--duration-s", options.duration_s,
                         "how long each of the two is measured, without load and again under it")
            ->capture_default_str()
            ->check(within(10.0, 86'400.0));
    realtime->add_flag("--quick", options.quick, "9 s each: shows that it works, not how long the tail is")
        ->excludes(duration);
    return {
        .subcommand = realtime,
        .run = [shared](const StudySurroundings& surroundings) { run_realtime_study(*shared, surroundings); },
        .runs_one_by_one = true};
}

}  // namespace osteomill::study
