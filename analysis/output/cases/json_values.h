// Values of outcomes as JSON, beside what the library brings: vectors, and values that may not be there.
#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>

template <>
struct nlohmann::adl_serializer<glm::dvec3> {
    static void to_json(nlohmann::json& json, const glm::dvec3& v) { json = {v.x, v.y, v.z}; }
    static void from_json(const nlohmann::json& json, glm::dvec3& v) {
        v = {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
    }
};

template <typename Value>
struct nlohmann::adl_serializer<std::optional<Value>> {
    static void to_json(nlohmann::json& json, const std::optional<Value>& value) {
        json = nlohmann::json::array();
        if (value) json.push_back(*value);
    }
    static void from_json(const nlohmann::json& json, std::optional<Value>& value) {
        if (!json.empty()) value = json.at(0).get<Value>();
    }
};
