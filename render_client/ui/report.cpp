#include "render_client/ui/report.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace osteomill {

std::string to_json(const RenderReport& report) {
    const nlohmann::ordered_json json{{"frames", report.frame_times.count()},
                                      {"frame_ms",
                                       {{"p50", report.frame_times.percentile_ms(0.5)},
                                        {"p99", report.frame_times.percentile_ms(0.99)},
                                        {"max", report.frame_times.percentile_ms(1.0)}}},
                                      {"gl_renderer", report.gl_renderer},
                                      {"bone_checksum", fmt::format("{:016x}", report.bone_checksum)},
                                      {"dirty_bricks_uploaded", report.dirty_bricks_uploaded},
                                      {"checksum_mismatches", report.checksum_mismatches},
                                      {"link_status", report.link_status}};
    // A status may quote what a server sent; bytes that are no UTF-8 must not cost the whole report.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_report(const RenderReport& report, const std::filesystem::path& file) {
    std::ofstream stream(file);
    stream << to_json(report);
    stream.close();
    if (!stream) throw std::runtime_error("cannot write the report " + file.string());
}

}  // namespace osteomill
