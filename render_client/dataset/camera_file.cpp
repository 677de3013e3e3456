#include "render_client/dataset/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <set>
#include <sstream>

#include "common/files/input_file.h"
#include "common/scene/scene_file.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "common/text/csv.h"
#include "common/text/words.h"

namespace osteomill {

namespace {

constexpr std::int64_t largest_edge_px = 8192;
constexpr std::size_t most_cameras = 64;
const double default_field_of_view_rad = Camera{}.field_of_view_rad;

std::array<double, 8> numbers_of(const TableLines& lines) {
    const std::vector<std::string> cells = cells_of(lines.line());
    std::array<double, 8> numbers{};
    if (cells.size() != numbers.size())
        lines.fail(fmt::format("has {} cells, not the 8 of time_s,x,y,z,qx,qy,qz,qw", cells.size()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto number = finite_number(cells[i]);
        if (!number) lines.fail(fmt::format("has '{}', which is no number", cells[i]));
        numbers[i] = *number;
    }
    return numbers;
}

void read_path(DatasetCamera& camera, const std::filesystem::path& file) {
    TableLines lines(read_text(file, table_kind), file.string());
    for (bool is_first = true; lines.next(); is_first = false) {
        if (is_first && lines.line().starts_with("time_s")) continue;
        const std::array<double, 8> n = numbers_of(lines);
        const glm::dquat rotation(n[7], n[4], n[5], n[6]);
        if (std::abs(glm::length(rotation) - 1.0) > 1e-3) lines.fail("its quaternion is not of length 1");
        if (!camera.times_s.empty() && n[0] <= camera.times_s.back())
            lines.fail("its time is not behind the one before");
        camera.times_s.push_back(n[0]);
        camera.poses.push_back({{n[1], n[2], n[3]}, glm::normalize(rotation)});
    }
    if (camera.poses.empty()) lines.fail("has no pose; a line is time_s,x,y,z,qx,qy,qz,qw");
}

void read_pinhole(DatasetCamera& camera, TomlReader& reader) {
    const auto edge_px = [&](const char* key, int usual) {
        return static_cast<int>(reader.whole_number(key, 1, largest_edge_px).value_or(usual));
    };
    const glm::ivec2 size_px(edge_px("width_px", 640), edge_px("height_px", 480));
    const auto k = reader.rows("intrinsics", 3);
    camera.has_trainees_angle = camera.follows_trainee && !k;
    camera.pinhole = pinhole_of(size_px, default_field_of_view_rad);
    if (!k) return;
    const bool is_pinhole = k->size() == 3 && (*k)[0][0] > 0.0 && (*k)[1][1] > 0.0 && (*k)[0][1] == 0.0 &&
                            (*k)[1][0] == 0.0 && (*k)[2] == std::vector{0.0, 0.0, 1.0};
    if (!is_pinhole)
        reader.fail("intrinsics", "must be [[fx, 0, cx], [0, fy, cy], [0, 0, 1]] in pixels, fx, fy above 0");
    camera.pinhole = {size_px, {(*k)[0][0], (*k)[1][1]}, {(*k)[0][2], (*k)[1][2]}};
}

void read_pose(DatasetCamera& camera, TomlReader& reader, const std::filesystem::path& folder) {
    const auto eye_mm = reader.place("eye_mm"), target_mm = reader.place("target_mm");
    const auto up = reader.direction("up");
    const auto path = reader.text("path");
    camera.follows_trainee = reader.choice("view", {"trainee"}).has_value();
    if (path && (eye_mm || target_mm || up))
        reader.fail("path", "stands in place of eye_mm, target_mm and up");
    if (camera.follows_trainee && (path || eye_mm || target_mm || up))
        reader.fail("view", "stands in place of eye_mm, target_mm, up and path");
    if (path) return read_path(camera, folder / *path);
    if (!eye_mm && !target_mm && !up) return;
    const glm::dvec3 from = required(reader, "eye_mm", eye_mm);
    const glm::dvec3 to = required(reader, "target_mm", target_mm);
    if (glm::distance(from, to) < 1e-6) reader.fail("target_mm", "is where the eye is");
    camera.times_s = {0.0};
    camera.poses = {looking_at(from, to, up.value_or(glm::dvec3(0.0, 0.0, 1.0)))};
}

/// A point on the axis between the two, at the distance of convergence, is in the middle of both pictures.
DatasetCamera one_of_pair(DatasetCamera camera, const char* side, double aside_mm, double convergence_mm) {
    camera.name += side;
    camera.aside_mm = aside_mm;
    camera.aside_slope = aside_mm / convergence_mm;
    camera.pinhole.centre_px.x += camera.pinhole.focal_px.x * camera.aside_slope;
    return camera;
}

void read_camera(TomlReader& reader, const std::filesystem::path& folder,
                 std::vector<DatasetCamera>& cameras) {
    DatasetCamera camera;
    camera.name = required(reader, "name", reader.text("name"));
    const auto is_fit = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
    };
    if (camera.name.empty() || !std::ranges::all_of(camera.name, is_fit))
        reader.fail("name",
                    fmt::format("'{}' must be of letters, digits, - and _: it names a folder", camera.name));
    read_pose(camera, reader, folder);
    read_pinhole(camera, reader);
    const auto baseline_mm = reader.number("baseline_mm", {1e-3, 1e3});
    const auto convergence_mm = reader.number("convergence_mm", {1e-3, 1e6});
    if (convergence_mm && !baseline_mm) reader.fail("convergence_mm", "is of a pair: give baseline_mm, too");
    reader.refuse_other_keys();
    if (!baseline_mm) {
        cameras.push_back(camera);
        return;
    }
    const double far_mm = convergence_mm.value_or(std::numeric_limits<double>::infinity());
    cameras.push_back(one_of_pair(camera, "_left", -0.5 * *baseline_mm, far_mm));
    cameras.push_back(one_of_pair(camera, "_right", 0.5 * *baseline_mm, far_mm));
}

}  // namespace

Pose DatasetCamera::pose_at(double time_s, const Pose& first_view,
                            const std::optional<Viewpoint>& trainee) const {
    Pose pose = poses.empty() ? first_view : poses.back();
    const auto next = std::ranges::upper_bound(times_s, time_s) - times_s.begin();
    if (const auto i = static_cast<std::size_t>(next); i == 0 && !poses.empty()) {
        pose = poses.front();
    } else if (i < times_s.size()) {
        const double part = (time_s - times_s[i - 1]) / (times_s[i] - times_s[i - 1]);
        pose = {glm::mix(poses[i - 1].position_mm, poses[i].position_mm, part),
                glm::slerp(poses[i - 1].rotation, poses[i].rotation, part)};
    }
    if (follows_trainee && trainee) pose = {trainee->eye_mm, trainee->rotation};
    pose.position_mm += pose.rotation * glm::dvec3(aside_mm, 0.0, 0.0);
    return pose;
}

Pinhole DatasetCamera::pinhole_at(const std::optional<Viewpoint>& trainee) const {
    if (!has_trainees_angle || !trainee) return pinhole;
    Pinhole zoomed = pinhole_of(pinhole.size_px, trainee->field_of_view_rad);
    zoomed.centre_px.x += zoomed.focal_px.x * aside_slope;
    return zoomed;
}

std::vector<DatasetCamera> default_cameras() {
    DatasetCamera camera;
    camera.pinhole = pinhole_of(camera.pinhole.size_px, default_field_of_view_rad);
    return {camera};
}

void require_view(std::span<const DatasetCamera> cameras, const std::function<bool()>& has_view,
                  const std::filesystem::path& recording) {
    if (std::ranges::any_of(cameras, &DatasetCamera::follows_trainee) && !has_view())
        throw std::runtime_error(recording.string() + ": does not say from where the trainee looked");
}

std::vector<DatasetCamera> cameras_named(const std::string& which) {
    if (which.empty()) return default_cameras();
    if (which != "trainee") return read_cameras(which);
    std::vector<DatasetCamera> cameras = default_cameras();
    cameras.front().name = which;
    cameras.front().follows_trainee = cameras.front().has_trainees_angle = true;
    return cameras;
}

std::vector<DatasetCamera> read_cameras(const std::filesystem::path& file) {
    return parse_cameras(read_toml_text(file, "a file of cameras"), file.string(), file.parent_path());
}

std::vector<DatasetCamera> parse_cameras(std::string_view text, const std::string& name,
                                         const std::filesystem::path& folder) {
    const toml::table root = parse_toml(text, name);
    TomlReader reader(root, name, "the cameras");
    std::vector<DatasetCamera> cameras;
    for (TomlReader& table : reader.tables("cameras")) read_camera(table, folder, cameras);
    reader.refuse_other_keys();
    if (cameras.empty()) reader.fail("cameras", "has no camera: write [[cameras]]");
    if (cameras.size() > most_cameras)
        reader.fail("cameras", fmt::format("has {} cameras, may have {}", cameras.size(), most_cameras));
    std::set<std::string> names;
    for (const DatasetCamera& camera : cameras)
        if (!names.insert(camera.name).second)
            reader.fail("cameras", fmt::format("has two cameras called '{}'", camera.name));
    return cameras;
}

}  // namespace osteomill
