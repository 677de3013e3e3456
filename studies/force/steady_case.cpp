#include "studies/force/steady_case.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>

#include "common/files/input_file.h"
#include "common/scene/burr.h"
#include "common/scene/burr_profile.h"
#include "common/text/foreign_json.h"

namespace osteomill::study {

namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 12> keys{
    "name",         "radius_mm",    "velocity_mm_s", "spindle_axis", "depth_mm",
    "rpm",          "edges",        "K_N_mm2",       "spin",         "previous_groove_mm_higher",
    "mean_force_N", "removal_mm3_s"};

/// One object of the array, and how to complain about it.
class CaseObject {
  public:
    CaseObject(const json& object, std::string where) : object_(object), where_(std::move(where)) {
        if (!object.is_object()) fail("is not an object");
        if (const auto name = object.find("name"); name != object.end() && name->is_string())
            where_ += fmt::format(" '{}'", name->get<std::string>());
        for (const auto& [key, value] : object.items())
            if (std::find(keys.begin(), keys.end(), key) == keys.end())
                fail(fmt::format("unknown key '{}'; a case has {}", key, fmt::join(keys, ", ")));
        for (const std::string_view key : keys)
            if (!object.contains(key)) fail(fmt::format("'{}' is missing", key));
    }

    std::string text(std::string_view key) const {
        const json& value = object_.at(std::string(key));
        if (!value.is_string()) wrong(key, "a text");
        return value.get<std::string>();
    }

    double number(std::string_view key, std::string_view wanted, bool (*is_good)(double)) const {
        const json& value = object_.at(std::string(key));
        if (!value.is_number() || !is_good(value.get<double>())) wrong(key, wanted);
        return value.get<double>();
    }

    glm::dvec3 vector(std::string_view key, std::string_view wanted,
                      bool (*is_good)(const glm::dvec3&)) const {
        const json& value = object_.at(std::string(key));
        const bool is_vector =
            value.is_array() && value.size() == 3 &&
            std::all_of(value.begin(), value.end(), [](const json& j) { return j.is_number(); });
        if (!is_vector) wrong(key, wanted);
        const glm::dvec3 v(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
        if (!is_good(v)) wrong(key, wanted);
        return v;
    }

    bool is_null(std::string_view key) const { return object_.at(std::string(key)).is_null(); }

  private:
    [[noreturn]] void fail(const std::string& what) const { throw std::runtime_error(where_ + ": " + what); }
    [[noreturn]] void wrong(std::string_view key, std::string_view wanted) const {
        fail(fmt::format("'{}' is {}; it must be {}", key, object_.at(std::string(key)).dump(), wanted));
    }

    const json& object_;
    std::string where_;
};

bool any(const glm::dvec3&) {
    return true;
}
bool is_direction(const glm::dvec3& v) {
    return glm::length(v) > 1e-9;
}
bool is_positive(double value) {
    return value > 0.0;
}

SteadyCase case_of(const CaseObject& object) {
    SteadyCase c;
    c.name = object.text("name");
    c.burr.diameter_mm = 2.0 * object.number("radius_mm", "a number above 0", is_positive);
    c.velocity_mm_per_s = object.vector("velocity_mm_s", "three numbers, not all 0", is_direction);
    c.spindle_axis = glm::normalize(object.vector("spindle_axis", "three numbers, not all 0", is_direction));
    c.depth_mm = object.number("depth_mm", "a number above 0", is_positive);
    c.burr.spindle_rev_per_s = object.number("rpm", "a number above 0", is_positive) / 60.0;
    c.burr.edges = static_cast<int>(object.number("edges", "a whole number, 1 to 1000", [](double v) {
        return v >= 1.0 && v <= 1000.0 && v == std::floor(v);
    }));
    c.burr.cutting_coefficients_n_per_mm2 =
        object.vector("K_N_mm2", "three numbers (K_t, K_r, K_a), none below 0",
                      [](const glm::dvec3& k) { return k.x >= 0.0 && k.y >= 0.0 && k.z >= 0.0; });
    const double spin = object.number("spin", "1 (counter-clockwise) or -1 (clockwise)",
                                      [](double v) { return std::abs(v) == 1.0; });
    c.burr.sense = spin > 0.0 ? SpindleSense::counter_clockwise : SpindleSense::clockwise;
    if (!object.is_null("previous_groove_mm_higher"))
        c.previous_groove_mm_higher =
            object.number("previous_groove_mm_higher", "null or a number above 0", is_positive);
    c.mean_force_n = object.vector("mean_force_N", "three numbers", any);
    c.removal_mm3_per_s =
        object.number("removal_mm3_s", "a number, 0 or more", [](double v) { return v >= 0.0; });
    return c;
}

json parsed(const std::filesystem::path& file) {
    const std::string text = read_text(file, json_kind);
    try {
        return parse_foreign_json(text, file.string());
    } catch (const json::exception& error) {
        // "[json.exception.parse_error.101] parse error at line 3, column 7: ...": the part after the
        // bracket.
        const std::string said = error.what();
        throw std::runtime_error(file.string() + ": is not JSON: " + said.substr(said.find("] ") + 2));
    }
}

/// The groove is where the head comes by: the distance from a convex body is convex along a line, and its
/// least is found by golden section.
BoneFunction bone_with_groove_of_head(const SteadyCase& c, const glm::dvec3& groove,
                                      const glm::dvec3& direction) {
    const auto profile = std::make_shared<BurrProfile>(c.burr.head, c.burr.diameter_mm);
    const glm::dmat3 to_burr = glm::transpose(burr_frame(c.spindle_axis));
    const double reach_mm = 2.0 * (profile->bounding_radius() + profile->largest_radius());
    return [=, up = c.up](const glm::dvec3& p) {
        if (glm::dot(p, up) > 0.0) return 0.0;
        const glm::dvec3 w = p - groove;
        const auto distance = [&](double along_mm) {
            const glm::dvec3 in_burr = to_burr * (w - along_mm * direction);
            return profile->nearest(std::hypot(in_burr.x, in_burr.y), in_burr.z).distance;
        };
        constexpr double golden = 0.61803398874989485;
        double low = glm::dot(w, direction) - reach_mm;
        double high = low + 2.0 * reach_mm;
        for (int i = 0; i < 32; ++i) {
            const double a = high - golden * (high - low);
            const double b = low + golden * (high - low);
            (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
        }
        return distance(0.5 * (low + high)) > 0.0 ? 1.0 : 0.0;
    };
}

}  // namespace

std::ostream& operator<<(std::ostream& out, const SteadyCase& c) {
    return out << c.name;
}

double above_lowest_mm(const SteadyCase& c) {
    if (c.burr.is_ball()) return c.burr.radius_mm();
    return BurrProfile(c.burr.head, c.burr.diameter_mm)
        .reach_along(glm::transpose(burr_frame(c.spindle_axis)) * -c.up);
}

SteadyMotion motion_of(const SteadyCase& c) {
    return {.burr = c.burr,
            .position_mm = (above_lowest_mm(c) - c.depth_mm) * c.up,
            .spindle_axis = c.spindle_axis,
            .velocity_mm_per_s = c.velocity_mm_per_s};
}

BoneFunction bone_of(const SteadyCase& c) {
    const glm::dvec3 up = c.up;
    if (!c.previous_groove_mm_higher)
        return [up](const glm::dvec3& p) { return glm::dot(p, up) <= 0.0 ? 1.0 : 0.0; };
    const glm::dvec3 groove = motion_of(c).position_mm + *c.previous_groove_mm_higher * up;
    const glm::dvec3 direction = glm::normalize(c.velocity_mm_per_s);
    if (!c.burr.is_ball()) return bone_with_groove_of_head(c, groove, direction);
    const double radius = c.burr.radius_mm();
    return [=](const glm::dvec3& p) {
        if (glm::dot(p, up) > 0.0) return 0.0;
        const glm::dvec3 w = p - groove;
        return glm::length(w - glm::dot(w, direction) * direction) > radius ? 1.0 : 0.0;
    };
}

std::vector<SteadyCase> read_steady_cases(const std::filesystem::path& file) {
    const json array = parsed(file);
    if (!array.is_array()) throw std::runtime_error(file.string() + ": is not an array of cases");
    if (array.empty()) throw std::runtime_error(file.string() + ": holds no case");
    std::vector<SteadyCase> cases;
    cases.reserve(array.size());
    for (const json& object : array)
        cases.push_back(
            case_of(CaseObject(object, fmt::format("{}: case {}", file.string(), cases.size() + 1))));
    return cases;
}

}  // namespace osteomill::study
