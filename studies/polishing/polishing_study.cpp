#include "studies/polishing/polishing_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <variant>

#include "analysis/output/output_files.h"
#include "analysis/output/study_run.h"
#include "imaging/phantoms/phantom.h"
#include "studies/polishing/claims.h"
#include "studies/polishing/polishing_run.h"
#include "studies/polishing/published_figures.h"
#include "studies/polishing/tooth_period.h"

namespace osteomill::study {

namespace {

Bone bone_of_cube() {
    return bone_from_hu(std::get<HuSlices>(make_phantom("cube")), phantom_threshold_hu,
                        phantom_scene("cube").stiffness);
}

const FigureRun& figure_of(const std::vector<FigureRun>& figures, const std::string& force_model,
                           const std::string& coupling) {
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const FigureRun& figure) {
        return figure.setup.force_model == force_model && figure.setup.coupling == coupling;
    });
    if (found == figures.end()) throw std::logic_error("no run of " + force_model + ", " + coupling);
    return *found;
}

/// One run of the study: what was asked, where it goes.
class PolishingStudy {
  public:
    PolishingStudy(const PolishingStudyOptions& options, const StudySurroundings& surroundings)
        : quick_(options.quick),
          run_(options.out, surroundings),
          logs_(options.out / "runs"),
          cube_{bone_of_cube(), options.has_edge_forces ? glm::dvec3(0.3, 0.3, 0.0) : glm::dvec3(0.0)} {
        make_folder(logs_);
    }

    void run() {
        const auto figures = chapter("figures 6, 7 and 8", &run_figures);
        run_.write(table_of(figures), "figures");
        for (const FigureRun& figure : figures)
            run_.write(series_of(figure.run.record), figure.setup.force_model + "_" + figure.setup.coupling);
        const auto by_edges = chapter("edges", &vary_edges);
        run_.write(table_of(by_edges), "edges");
        for (const ToothPeriodForce& force : by_edges)
            run_.write(clip_of(force), fmt::format("tooth_period_{}", force.setup.edges));
        const auto by_speed = chapter("spindle speeds", &vary_speed);
        run_.write(table_of(by_speed), "speeds");

        std::vector<Claim> claims = claims_of_shape(figures);
        add(claims, claims_of_contact(figures));
        add(claims, edges_claims(by_edges));
        add(claims, speed_claims(by_speed));
        const Table table = table_of(claims);
        run_.write(table, "claims");
        run_.write(table.json(), "claims");
        run_.say("{}", text_of(claims));

        run_.draw({"polishing_depth", "polishing_milling", "polishing_point_spring", "polishing_edges"});
        run_.say("claims.json, tables (CSV) and charts (SVG) are in {}", run_.out().string());
    }

  private:
    /// A chapter with a bar of its own.
    template <typename Found>
    Found chapter(const std::string& title, Found (*work)(const Specimen&, bool, const std::filesystem::path&,
                                                          const ReportProgress&)) const {
        return run_.chapter(
            title, [&](const ReportProgress& progress) { return work(cube_, quick_, logs_, progress); });
    }

    static void add(std::vector<Claim>& claims, std::vector<Claim> more) {
        for (Claim& claim : more) claims.push_back(std::move(claim));
    }

    /// Which of the paper's claims hold depends on how the slide lies on the bone: asked of strokes to and
    /// fro and of a single one, of the model alone and of what the hand feels.
    std::vector<Claim> claims_of_shape(const std::vector<FigureRun>& figures) const {
        const PolishingSetup one_stroke{.stroke_mm = single_stroke_mm};
        const FigureRun& implicit = figure_of(figures, "milling", "implicit");
        const ForceRecord on_rails = run_on_rails(cube_, {}, logs_ / "rails.csv").record;
        run_.write(series_of(on_rails), "as_meant");
        const std::vector<std::pair<std::string, ForceRecord>> records{
            {"milling, on rails", on_rails},
            {"milling, on rails, one stroke",
             run_on_rails(cube_, one_stroke, logs_ / "slot_rails.csv").record},
            {implicit.name(), implicit.run.record},
            {implicit.name() + ", one stroke", run_by_hand(cube_, one_stroke, logs_ / "slot.csv").record},
            {"point-spring, interpolate", figure_of(figures, "point-spring", "interpolate").run.record}};
        std::vector<Claim> claims;
        for (const auto& [where, record] : records) add(claims, rising_claims(where, record));
        for (const auto& [where, record] : records) claims.push_back(proportion_claim(where, record));
        return claims;
    }

    static std::vector<Claim> claims_of_contact(const std::vector<FigureRun>& figures) {
        std::vector<Claim> claims;
        for (const FigureRun& figure : figures) {
            const std::string& coupling = figure.setup.coupling;
            if (coupling == "interpolate" || coupling == "hold")
                claims.push_back(
                    chatter_claim("without sample-estimate-hold it is nearly unstable", figure, true));
            else if (coupling == "implicit")
                claims.push_back(chatter_claim("implicit is steady (not in the paper)", figure, false));
            else
                claims.push_back(chatter_claim("with sample-estimate-hold it is steady", figure, false));
        }
        return claims;
    }

    std::vector<Claim> speed_claims(const std::vector<ToothPeriodForce>& by_speed) const {
        const auto claim = [](const std::string& where, const PolishingSetup& slow, double slow_n,
                              const PolishingSetup& fast, double fast_n) {
            return speed_claim(where, slow.spindle_rpm, slow_n, fast.spindle_rpm, fast_n);
        };
        const PolishingSetup slow = by_speed.front().setup;
        const PolishingSetup fast = by_speed.back().setup;
        const auto by_hand_n = [&](const PolishingSetup& setup) {
            return mean_force_n(run_by_hand(cube_, setup, logs_ / "by_hand.csv").record);
        };
        return {claim("milling, on rails", slow, by_speed.front().mean_n, fast, by_speed.back().mean_n),
                claim("milling, implicit", slow, by_hand_n(slow), fast, by_hand_n(fast))};
    }

    bool quick_;
    StudyRun run_;
    std::filesystem::path logs_;
    Specimen cube_;
};

}  // namespace

void run_polishing_study(const PolishingStudyOptions& options, const StudySurroundings& surroundings) {
    PolishingStudy(options, surroundings).run();
}

}  // namespace osteomill::study
