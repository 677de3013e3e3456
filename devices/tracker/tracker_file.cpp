#include "devices/tracker/tracker_file.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/scene/scene_file.h"
#include "common/scene/toml_reader.h"
#include "common/scene/toml_text.h"
#include "devices/tracker/transform_stream.h"

namespace osteomill {

namespace {

using Points = Eigen::Matrix3Xd;

/// Root mean square of the distances from the straight line that fits best.
double spread_off_a_line_mm(const Points& points) {
    const Points centred = points.colwise() - points.rowwise().mean();
    const Eigen::Matrix3d scatter = centred * centred.transpose();
    const Eigen::Vector3d along = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter).eigenvalues();
    return std::sqrt(std::max(0.0, along[0] + along[1]) / static_cast<double>(points.cols()));
}

void require_spread(const Points& points, const char* space) {
    if (spread_off_a_line_mm(points) < least_spread_mm)
        throw std::invalid_argument(fmt::format(
            "the points lie on one line in {}, which leaves the turn about it open; add one beside it",
            space));
}

}  // namespace

PointRegistration registered(std::span<const PointPair> pairs, double largest_residual_mm) {
    if (pairs.size() < 3)
        throw std::invalid_argument(
            fmt::format("there {} {} of [[points]]; a registration takes three or more",
                        pairs.size() == 1 ? "is" : "are", pairs.size()));
    Points tracker(3, pairs.size());
    Points patient(3, pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
            tracker(axis, static_cast<Eigen::Index>(i)) = pairs[i].tracker_mm[axis];
            patient(axis, static_cast<Eigen::Index>(i)) = pairs[i].patient_mm[axis];
        }
    require_spread(tracker, "the tracker's space");
    require_spread(patient, "the patient");

    const Eigen::Matrix4d motion = Eigen::umeyama(tracker, patient, false);
    PointRegistration result;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) result.mapping.rotation[column][row] = motion(row, column);
        result.mapping.offset_mm[row] = motion(row, 3);
    }
    const Points moved = (motion.topLeftCorner<3, 3>() * tracker).colwise() + motion.topRightCorner<3, 1>();
    const Eigen::RowVectorXd residual = (moved - patient).colwise().norm();
    result.residual_mm.assign(residual.begin(), residual.end());
    result.rms_mm = std::sqrt(residual.squaredNorm() / static_cast<double>(pairs.size()));
    result.worst = static_cast<std::size_t>(
        std::max_element(result.residual_mm.begin(), result.residual_mm.end()) - result.residual_mm.begin());
    const double largest_mm = result.residual_mm[result.worst];
    if (!(largest_mm <= largest_residual_mm))
        throw std::invalid_argument(
            fmt::format("point '{}' is {:.2f} mm off after the best fit (rms {:.2f} mm), above "
                        "largest_residual_mm = {:g}; "
                        "measure it anew, or see whether points are exchanged",
                        pairs[result.worst].name, largest_mm, result.rms_mm, largest_residual_mm));
    return result;
}

namespace {

constexpr AllowedRange residual_range_mm{0.01, 20.0};
constexpr double usual_residual_mm = 2.0;
/// A tool is held in one hand.
constexpr double longest_tool_mm = 1000.0;

glm::dvec3 vector_within(TomlReader& reader, std::string_view key, double most_mm) {
    const glm::dvec3 value = required(reader, key, reader.vector(key));
    if (!(glm::length(value) <= most_mm))
        reader.fail(key, fmt::format("'{}' must lie within {:g} mm", key, most_mm));
    return value;
}

TrackedHandpiece read_tool(TomlReader reader) {
    TrackedHandpiece tool;
    tool.burr_centre_mm = vector_within(reader, "burr_centre_mm", longest_tool_mm);
    tool.spindle_axis = required(reader, "spindle_axis", reader.direction("spindle_axis"));
    reader.refuse_other_keys();
    return tool;
}

std::string read_pedal(TomlReader reader) {
    const std::optional<std::string> string = reader.text("string");
    const std::optional<bool> always = reader.truth("always");
    reader.refuse_other_keys();
    if (string.has_value() == always.value_or(false))
        reader.fail("string",
                    "[pedal] takes one of 'string', the name of a STRING message, and 'always = true'");
    if (string && (string->empty() || string->size() > IgtlStream::longest_name))
        reader.fail("string",
                    fmt::format("'string' is a device name of 1 to {} characters", IgtlStream::longest_name));
    return string.value_or("");
}

double read_limit(TomlReader reader) {
    const double limit_mm =
        reader.number("largest_residual_mm", residual_range_mm).value_or(usual_residual_mm);
    reader.refuse_other_keys();
    return limit_mm;
}

}  // namespace

TrackerSetup parse_tracker_setup(std::string_view toml, const std::string& name) {
    const toml::table root = parse_toml(toml, name);
    TomlReader reader(root, name, "the tracker's file");
    TrackerSetup setup;
    setup.handpiece = read_tool(required(reader, "tool", reader.table("tool")));
    setup.handpiece.pedal = read_pedal(required(reader, "pedal", reader.table("pedal")));
    double limit_mm = usual_residual_mm;
    if (auto table = reader.table("registration")) limit_mm = read_limit(*std::move(table));
    for (TomlReader& point : reader.tables("points")) {
        PointPair pair;
        pair.name = point.text("name").value_or(fmt::format("{}", setup.points.size() + 1));
        pair.tracker_mm = required(point, "tracker_mm", point.place("tracker_mm"));
        pair.patient_mm = required(point, "patient_mm", point.place("patient_mm"));
        point.refuse_other_keys();
        setup.points.push_back(std::move(pair));
    }
    reader.refuse_other_keys();
    try {
        setup.registration = registered(setup.points, limit_mm);
    } catch (const std::invalid_argument& error) {
        throw SceneError(fmt::format("{}: {}", name, error.what()));
    }
    return setup;
}

TrackerSetup read_tracker_setup(const std::filesystem::path& path) {
    return parse_tracker_setup(read_toml_text(path, "a tracker registration"), path.string());
}

std::string residual_line(const TrackerSetup& setup) {
    const PointRegistration& fit = setup.registration;
    return fmt::format("registered by {} points: residual {:.2f} mm (rms), {:.2f} mm at the most, at '{}'",
                       setup.points.size(), fit.rms_mm, fit.residual_mm[fit.worst],
                       setup.points[fit.worst].name);
}

}  // namespace osteomill
