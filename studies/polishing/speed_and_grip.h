// At which spindle speeds and in which grips a coupling polishes without chatter.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/output/progress.h"
#include "common/bone/bone.h"
#include "studies/polishing/published_figures.h"

namespace osteomill::study {

/// How the stylus is held.
struct NamedGrip {
    std::string name;
    HandModel hand;
};
/// From light to braced: the simulator's two hands, one between them and one twice as stiff and heavy as the
/// firm one, the wrist rested. A bare arm is not among them, since nothing would move it along.
std::vector<NamedGrip> studied_grips(bool quick);

struct SpeedAndGrip {
    std::string grip;
    /// No encoder steps and no Coulomb friction, which hide limit cycles that are there.
    bool is_ideal_arm = false;
    FigureRun figure;

    bool is_steady() const { return figure.limit_cycle_n < chatter_n; }
};

/// The milling model through the published couplings at 100 Hz, and through `implicit` at 1 kHz to compare.
/// Only what the runs are judged by is kept, not their records. Files in `folder` come and go.
std::vector<SpeedAndGrip> sweep_speed_and_grip(const Specimen& cube, bool quick,
                                               const std::filesystem::path& folder, const Progress& progress);

std::string csv_of(const std::vector<SpeedAndGrip>& swept);
/// For people: a block a coupling and arm, a line a grip, a column a spindle speed, in each the limit cycle
/// in N with a star where it chatters.
std::string table_of(const std::vector<SpeedAndGrip>& swept);

}  // namespace osteomill::study
