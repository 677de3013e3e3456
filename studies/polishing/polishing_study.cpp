#include "studies/polishing/polishing_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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
        const std::vector<PolishingSetup> of_figures = setups_of_figures(quick_);
        const std::vector<PolishingSetup> by_edges_of = setups_by_edges(quick_);
        const std::vector<PolishingSetup> by_speed_of = setups_by_speed(quick_);
        const PolishingSetup one_stroke{.stroke_mm = single_stroke_mm};
        const auto runs_of_figures = run_.plan(of_figures, name_of, by_hand());
        const auto forces_by_edges = run_.plan(by_edges_of, name_of, tooth_period());
        const auto forces_by_speed = run_.plan(by_speed_of, name_of, tooth_period());
        const auto on_rails = run_.plan(std::vector{PolishingSetup{}, one_stroke}, name_of, this->on_rails());
        const auto one_by_hand = run_.plan(std::vector{one_stroke}, name_of, by_hand());
        const auto slow_and_fast =
            run_.plan(std::vector{by_speed_of.front(), by_speed_of.back()}, name_of, by_hand());
        if (!run_.perform()) return;

        std::vector<FigureRun> figures;
        for (PolishingRun& run : runs_of_figures.outcomes())
            figures.push_back(judged(of_figures[figures.size()], std::move(run)));
        run_.write(table_of(figures), "figures");
        for (const FigureRun& figure : figures)
            run_.write(series_of(figure.run.record), figure.setup.force_model + "_" + figure.setup.coupling);
        const auto by_edges = with_setups(forces_by_edges.outcomes(), by_edges_of);
        run_.write(table_of(by_edges), "edges");
        for (const ToothPeriodForce& force : by_edges)
            run_.write(clip_of(force), fmt::format("tooth_period_{}", force.setup.edges));
        const auto by_speed = with_setups(forces_by_speed.outcomes(), by_speed_of);
        run_.write(table_of(by_speed), "speeds");

        const std::vector<PolishingRun> as_meant = on_rails.outcomes();
        run_.write(series_of(as_meant[0].record), "as_meant");
        const std::vector<PolishingRun> at_speeds = slow_and_fast.outcomes();
        std::vector<Claim> claims = claims_of_shape(figures, as_meant[0].record, as_meant[1].record,
                                                    one_by_hand.outcomes().front().record);
        add(claims, claims_of_contact(figures));
        add(claims, edges_claims(by_edges));
        add(claims,
            speed_claims(by_speed, mean_force_n(at_speeds[0].record), mean_force_n(at_speeds[1].record)));
        const Table table = table_of(claims);
        run_.write(table, "claims");
        run_.write(table.json(), "claims");
        run_.say("{}", text_of(claims));

        run_.draw({"polishing_depth", "polishing_milling", "polishing_point_spring", "polishing_edges"});
        run_.say("claims.json, tables (CSV) and charts (SVG) are in {}", run_.out().string());
    }

  private:
    /// What tells a run from the others, and names its log.
    static std::string name_of(const PolishingSetup& setup) {
        return fmt::format("{}_{}_{:.0f}hz_{:.0f}rpm_{}edges_{:.0f}mm", setup.force_model, setup.coupling,
                           setup.milling_rate_hz, setup.spindle_rpm, setup.edges, setup.stroke_mm);
    }
    std::filesystem::path log_of(const char* how, const PolishingSetup& setup) const {
        return logs_ / fmt::format("{}_{}.csv", how, name_of(setup));
    }

    std::function<PolishingRun(const PolishingSetup&)> by_hand() const {
        return
            [this](const PolishingSetup& setup) { return run_by_hand(cube_, setup, log_of("hand", setup)); };
    }
    std::function<PolishingRun(const PolishingSetup&)> on_rails() const {
        return [this](const PolishingSetup& setup) {
            return run_on_rails(cube_, setup, log_of("rails", setup));
        };
    }
    std::function<ToothPeriodForce(const PolishingSetup&)> tooth_period() const {
        return [this](const PolishingSetup& setup) { return measure(cube_, setup, log_of("teeth", setup)); };
    }

    static std::vector<ToothPeriodForce> with_setups(std::vector<ToothPeriodForce> forces,
                                                     const std::vector<PolishingSetup>& setups) {
        for (std::size_t i = 0; i < forces.size(); ++i) forces[i].setup = setups[i];
        return forces;
    }

    static void add(std::vector<Claim>& claims, std::vector<Claim> more) {
        for (Claim& claim : more) claims.push_back(std::move(claim));
    }

    /// Which of the paper's claims hold depends on how the slide lies on the bone: asked of strokes to and
    /// fro and of a single one, of the model alone and of what the hand feels.
    static std::vector<Claim> claims_of_shape(const std::vector<FigureRun>& figures,
                                              const ForceRecord& on_rails, const ForceRecord& slot_on_rails,
                                              const ForceRecord& slot_by_hand) {
        const FigureRun& implicit = figure_of(figures, "milling", "implicit");
        const std::vector<std::pair<std::string, ForceRecord>> records{
            {"milling, on rails", on_rails},
            {"milling, on rails, one stroke", slot_on_rails},
            {implicit.name(), implicit.run.record},
            {implicit.name() + ", one stroke", slot_by_hand},
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

    static std::vector<Claim> speed_claims(const std::vector<ToothPeriodForce>& by_speed,
                                           double slow_by_hand_n, double fast_by_hand_n) {
        const ToothPeriodForce& slow = by_speed.front();
        const ToothPeriodForce& fast = by_speed.back();
        const auto claim = [&](const std::string& where, double slow_n, double fast_n) {
            return speed_claim(where, slow.setup.spindle_rpm, slow_n, fast.setup.spindle_rpm, fast_n);
        };
        return {claim("milling, on rails", slow.mean_n, fast.mean_n),
                claim("milling, implicit", slow_by_hand_n, fast_by_hand_n)};
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
