#include "render_client/ui/panels/transfer_editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace osteomill {

namespace {

/// IEC 61966-2-1, rounded to eight bits.
std::uint8_t srgb_from_linear(double linear) {
    const double value = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
}

}  // namespace

void TransferEditor::choose(const std::optional<TransferFunction>& function) {
    if (function == function_) return;
    function_ = function;
    selected_.reset();
    has_changed_ = true;
}

void TransferEditor::set_mode(TransferMode mode) {
    if (!function_ || function_->mode == mode) return;
    function_->mode = mode;
    has_changed_ = true;
}

void TransferEditor::select_near(double value, double opacity, double value_reach, double opacity_reach) {
    selected_.reset();
    if (!function_) return;
    double nearest = 1.0;
    for (std::size_t i = 0; i < function_->points.size(); ++i) {
        const TransferPoint& point = function_->points[i];
        const double away =
            std::hypot((point.value - value) / value_reach, (point.opacity - opacity) / opacity_reach);
        if (away > nearest) continue;
        nearest = away;
        selected_ = i;
    }
}

void TransferEditor::move(double value, double opacity) {
    if (!selected_) return;
    auto& points = function_->points;
    const std::size_t i = *selected_;
    // Two points at one value would be a step of which the order is lost.
    constexpr double least_gap = 1e-3;
    const double low = i > 0 ? points[i - 1].value + least_gap : 0.0;
    const double high = i + 1 < points.size() ? points[i + 1].value - least_gap : highest_value;
    TransferPoint moved = points[i];
    moved.value = std::clamp(value, std::min(low, high), std::max(low, high));
    moved.opacity = std::clamp(opacity, 0.0, 1.0);
    has_changed_ = has_changed_ || moved != points[i];
    points[i] = moved;
}

void TransferEditor::set_colour(const std::array<std::uint8_t, 3>& srgb) {
    if (!selected_ || function_->points[*selected_].srgb == srgb) return;
    function_->points[*selected_].srgb = srgb;
    has_changed_ = true;
}

void TransferEditor::remove() {
    if (!selected_ || function_->points.size() < 2) return;
    function_->points.erase(function_->points.begin() + static_cast<std::ptrdiff_t>(*selected_));
    selected_.reset();
    has_changed_ = true;
}

void TransferEditor::add(double value) {
    if (!function_) return;
    auto& points = function_->points;
    const glm::vec4 look = look_of(*function_, value);
    const auto place = std::upper_bound(points.begin(), points.end(), value,
                                        [](double v, const TransferPoint& point) { return v < point.value; });
    const TransferPoint point{
        value, {srgb_from_linear(look.r), srgb_from_linear(look.g), srgb_from_linear(look.b)}, look.a};
    selected_ = static_cast<std::size_t>(place - points.begin());
    points.insert(place, point);
    has_changed_ = true;
}

bool TransferEditor::take_change() {
    return std::exchange(has_changed_, false);
}

}  // namespace osteomill
