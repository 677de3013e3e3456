#include "studies/polishing/polishing_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <utility>
#include <variant>

#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"
#include "imaging/phantoms/phantom.h"
#include "imaging/progress.h"
#include "studies/polishing/claims.h"
#include "studies/polishing/polishing_run.h"
#include "studies/polishing/published_figures.h"
#include "studies/polishing/setup_survey.h"
#include "studies/polishing/speed_and_grip.h"
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
        : options_(options),
          surroundings_(surroundings),
          logs_(options.out / "runs"),
          cube_{bone_of_cube(), options.has_edge_forces ? glm::dvec3(0.3, 0.3, 0.0) : glm::dvec3(0.0)} {
        make_folder(logs_);
    }

    void run() {
        const auto setups = chapter("set-ups", &survey_setups);
        write(csv_of(setups), "setups.csv");
        const auto figures = chapter("figures 6, 7 and 8", &run_figures);
        write(csv_of(figures), "figures.csv");
        for (const FigureRun& figure : figures)
            write(series_csv(figure.run.record),
                  fmt::format("{}_{}.csv", figure.setup.force_model, figure.setup.coupling));
        const auto by_edges = chapter("edges", &vary_edges);
        write(csv_of(by_edges), "edges.csv");
        for (const ToothPeriodForce& force : by_edges)
            write(clip_csv(force), fmt::format("tooth_period_{}.csv", force.setup.edges));
        const auto by_speed = chapter("spindle speeds", &vary_speed);
        write(csv_of(by_speed), "speeds.csv");

        const std::vector<Claim> claims = claims_of(figures, by_edges, by_speed, setups);
        write(csv_of(claims), "claims.csv");
        write_json(json_of(claims), options_.out / "claims.json");
        surroundings_.said << table_of(claims) << std::endl;

        const auto swept = chapter("speeds and grips", &sweep_speed_and_grip);
        write(csv_of(swept), "speed_and_grip.csv");
        surroundings_.said << "limit cycle, N rms, by grip and spindle speed; * chatters\n"
                           << table_of(swept);

        for (const char* chart : {"polishing_depth", "polishing_milling", "polishing_point_spring",
                                  "polishing_stability", "polishing_edges"})
            draw_chart(chart_scripts(), chart, options_.out);
        surroundings_.said << fmt::format("\nclaims.json, tables (CSV) and charts (SVG) are in {}\n",
                                          options_.out.string());
    }

  private:
    /// A chapter with a bar of its own.
    template <typename Found>
    Found chapter(const std::string& title,
                  Found (*work)(const Specimen&, bool, const std::filesystem::path&, const Progress&)) const {
        ProgressLine line(surroundings_.progress, surroundings_.is_terminal, title);
        return work(cube_, options_.quick, logs_, line.reporter());
    }

    void write(const std::string& table, const std::string& name) const {
        write_text(table, options_.out / name);
    }

    static void add(std::vector<Claim>& claims, std::vector<Claim> more) {
        for (Claim& claim : more) claims.push_back(std::move(claim));
    }

    std::vector<Claim> claims_of(const std::vector<FigureRun>& figures,
                                 const std::vector<ToothPeriodForce>& by_edges,
                                 const std::vector<ToothPeriodForce>& by_speed,
                                 const std::vector<SurveyedSetup>& setups) const {
        std::vector<Claim> claims = claims_of_shape(figures);
        add(claims, claims_of_contact(figures));
        add(claims, edges_claims(by_edges));
        add(claims, speed_claims(by_speed, setups));
        return claims;
    }

    /// Which of the paper's claims hold depends on how the slide lies on the bone: asked of strokes to and
    /// fro and of a single one, of the model alone and of what the hand feels.
    std::vector<Claim> claims_of_shape(const std::vector<FigureRun>& figures) const {
        const PolishingSetup one_stroke{.stroke_mm = single_stroke_mm};
        const FigureRun& implicit = figure_of(figures, "milling", "implicit");
        const ForceRecord on_rails = run_on_rails(cube_, {}, logs_ / "rails.csv").record;
        write(series_csv(on_rails), "as_meant.csv");
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

    static std::vector<Claim> speed_claims(const std::vector<ToothPeriodForce>& by_speed,
                                           const std::vector<SurveyedSetup>& setups) {
        std::vector<Claim> claims{speed_claim("milling, on rails", by_speed.front().setup.spindle_rpm,
                                              by_speed.front().mean_n, by_speed.back().setup.spindle_rpm,
                                              by_speed.back().mean_n)};
        std::vector<SurveyedSetup> same_stroke;
        for (const SurveyedSetup& s : setups)
            if (s.setup.stroke_mm == PolishingSetup{}.stroke_mm) same_stroke.push_back(s);
        claims.push_back(speed_claim("milling, implicit", same_stroke.front().setup.spindle_rpm,
                                     same_stroke.front().mean_force_n, same_stroke.back().setup.spindle_rpm,
                                     same_stroke.back().mean_force_n));
        return claims;
    }

    const PolishingStudyOptions& options_;
    const StudySurroundings& surroundings_;
    std::filesystem::path logs_;
    Specimen cube_;
};

}  // namespace

void run_polishing_study(const PolishingStudyOptions& options, const StudySurroundings& surroundings) {
    PolishingStudy(options, surroundings).run();
}

}  // namespace osteomill::study
