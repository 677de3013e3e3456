#include "studies/realtime/realtime_options.h"

#include "common/program/option_checks.h"

namespace osteomill::study {

CLI::App* add_realtime(CLI::App& app, RealtimeStudyOptions& options) {
    options.out = "study/realtime";
    CLI::App* realtime = app.add_subcommand("realtime",
                                            "how late the haptic loop wakes and how long it takes, in turns "
                                            "with cyclictest; then under stress-ng");
    realtime->add_option("--out", options.out, "folder for what the study writes; made if it is not there")
        ->capture_default_str();
    CLI::Option* const duration =
        realtime
            ->add_option("--duration-s", options.duration_s,
                         "how long each of the two is measured, without load and again under it")
            ->capture_default_str()
            ->check(within(10.0, 86'400.0));
    realtime->add_flag("--quick", options.quick, "9 s each: shows that it works, not how long the tail is")
        ->excludes(duration);
    return realtime;
}

}  // namespace osteomill::study
