#include "render_client/ui/run_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "common/files/atomic_file.h"

namespace osteomill {

namespace {

nlohmann::ordered_json json_of(const std::optional<TexturePlan>& textures) {
    if (!textures) return nullptr;
    constexpr double bytes_per_mib = 1024.0 * 1024.0;
    return {{"layout", textures->layout == BoneLayout::dense ? "dense" : "atlas"},
            {"coarsening", textures->coarsening},
            {"mib", static_cast<double>(textures->bytes) / bytes_per_mib}};
}

}  // namespace

std::string to_json(const RenderReport& report) {
    const nlohmann::ordered_json json{{"frames", report.frame_times.count()},
                                      {"frame_ms",
                                       {{"p50", report.frame_times.percentile_ms(0.5)},
                                        {"p99", report.frame_times.percentile_ms(0.99)},
                                        {"max", report.frame_times.percentile_ms(1.0)}}},
                                      {"gl_renderer", report.gl_renderer},
                                      {"bone_checksum", fmt::format("{:016x}", report.bone_checksum)},
                                      {"bone_textures", json_of(report.textures)},
                                      {"dirty_bricks_uploaded", report.dirty_bricks_uploaded},
                                      {"checksum_mismatches", report.checksum_mismatches},
                                      {"link_status", report.link_status}};
    // A status may quote a server's text; bytes that are no UTF-8 must not cost the whole report.
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_report(const RenderReport& report, const std::filesystem::path& file) {
    write_atomic_file(file, to_json(report));
}

}  // namespace osteomill
