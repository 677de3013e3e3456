#include "analysis/output/study_run.h"

#include "analysis/output/chart.h"
#include "analysis/output/output_files.h"

namespace osteomill::study {

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

}  // namespace osteomill::study
