#include "render_client/ui/panels/live_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/words/translation.h"
#include "render_client/ui/panels/round_number.h"

namespace osteomill {

void ToolHistory::add(const ToolState& tool) {
    if (!samples_.empty() && tool.time_s < samples_.back().time_s) samples_.clear();
    if (!samples_.empty() && tool.time_s == samples_.back().time_s) return;
    samples_.push_back({tool.time_s, tool.force_n, tool.depth_mm, tool.removed_mm3});
    while (samples_.front().time_s < tool.time_s - kept_s) samples_.pop_front();
}

namespace {

constexpr std::array<Tone, 3> axis_tones{Tone::left, Tone::back, Tone::up};
constexpr std::array<const char*, 3> axis_names{"left", "back", "up"};

// Finer than this a scale would show the noise of an encoder.
constexpr double smallest_force_n = 0.2;
constexpr double smallest_depth_mm = 0.2;
constexpr double smallest_volume_mm3 = 0.1;

struct Line {
    Tone tone;
    std::vector<PlotSample> samples;
};

template <typename Value>
Line line_of(const ToolHistory& history, Tone tone, Value&& value) {
    Line line{tone, {}};
    const double newest_s = history.samples().empty() ? 0.0 : history.samples().back().time_s;
    for (const ToolHistory::Sample& sample : history.samples())
        if (const std::optional<double> known = value(sample))
            line.samples.push_back({newest_s - sample.time_s, *known});
    return line;
}

std::vector<Line> force_lines(const ToolHistory& history) {
    std::vector<Line> lines;
    for (int axis = 0; axis < 3; ++axis)
        lines.push_back(line_of(history, axis_tones[static_cast<std::size_t>(axis)],
                                [axis](const auto& sample) { return std::optional(sample.force_n[axis]); }));
    return lines;
}

PlotRange range_of(const std::vector<Line>& lines, double smallest_span) {
    double least = 0.0, most = 0.0;
    for (const Line& line : lines)
        for (const PlotSample& sample : line.samples) {
            least = std::min(least, sample.value);
            most = std::max(most, sample.value);
        }
    return plot_range(least, most, smallest_span);
}

class PlotColumn {
  public:
    PlotColumn(const PanelPainter& painter, const PanelPlace& place)
        : painter_(painter),
          left_(place.first.x + painter.padding()),
          width_(place.size.x - 2.0f * painter.padding()),
          pen_y_(place.first.y + painter.padding()) {}

    /// One row of text, in pieces.
    void write(const TextLine& line) {
        float right = left_;
        for (const TextPiece& piece : line) {
            painter_.draw_text({right, pen_y_}, painter_.theme()[piece.tone], piece.text);
            right += painter_.width_of(piece.text);
        }
        pen_y_ += painter_.line_height();
    }

    void plot(const std::vector<Line>& lines, const PlotRange& range, float height) {
        const float axis_width = 3.2f * ImGui::GetFontSize();
        const glm::vec2 first(left_ + axis_width, pen_y_);
        const glm::vec2 size(width_ - axis_width, height);
        const ImU32 grid = colour_of(painter_.theme().grid);
        ImDrawList& canvas = painter_.canvas();
        for (const double value : {range.low, 0.0, range.high}) {
            const float y =
                first.y + size.y * static_cast<float>((range.high - value) / (range.high - range.low));
            canvas.AddLine({first.x, y}, {first.x + size.x, y}, grid, painter_.scale());
            if (value == 0.0 && range.low < 0.0 && range.high > 0.0) continue;
            label(value, {first.x, y}, range);
        }
        for (double age_s = 0.0; age_s <= ToolHistory::kept_s; age_s += 5.0) {
            const float x = first.x + size.x * static_cast<float>(1.0 - age_s / ToolHistory::kept_s);
            canvas.AddLine({x, first.y}, {x, first.y + size.y}, grid, painter_.scale());
        }
        canvas.PushClipRect(to_imgui(first), to_imgui(first + size), true);
        for (const Line& line : lines) {
            std::vector<ImVec2> points;
            for (const glm::vec2& point : plot_points(line.samples, ToolHistory::kept_s, range, size))
                points.push_back(to_imgui(first + point));
            canvas.AddPolyline(points.data(), static_cast<int>(points.size()),
                               colour_of(painter_.theme()[line.tone]), ImDrawFlags_None,
                               1.5f * painter_.scale());
        }
        canvas.PopClipRect();
        pen_y_ += height + 0.3f * ImGui::GetFontSize();
    }

    void write_times() {
        const float axis_width = 3.2f * ImGui::GetFontSize();
        const auto write_at = [&](double age_s, float part_left, const std::string& text) {
            const float x = left_ + axis_width +
                            (width_ - axis_width) * static_cast<float>(1.0 - age_s / ToolHistory::kept_s);
            painter_.draw_text({x - part_left * small_print * painter_.width_of(text), pen_y_},
                               painter_.theme()[Tone::dim], text, small_print);
        };
        write_at(ToolHistory::kept_s, 0.0f, fmt::format("-{:.0f} s", ToolHistory::kept_s));
        write_at(0.5 * ToolHistory::kept_s, 0.5f, fmt::format("-{:.0f} s", 0.5 * ToolHistory::kept_s));
        write_at(0.0, 1.0f, tr("now"));
        pen_y_ += painter_.line_height();
    }

  private:
    /// Writes the label of a grid line, left of the plot and within its height.
    void label(double value, const glm::vec2& at, const PlotRange& range) const {
        const std::string text = spoken_number("{:g}", value);
        const float height = small_print * ImGui::GetFontSize();
        const float up = value == range.low ? height : value == range.high ? 0.0f : 0.5f * height;
        painter_.draw_text(
            {at.x - small_print * painter_.width_of(text) - 4.0f * painter_.scale(), at.y - up},
            painter_.theme()[Tone::dim], text, small_print);
    }

    const PanelPainter& painter_;
    float left_;
    float width_;
    float pen_y_;
};

float force_plot_height(PlotDetail detail) {
    return (detail == PlotDetail::all ? 4.6f : 4.0f) * ImGui::GetFontSize();
}

float small_plot_height() {
    return 2.6f * ImGui::GetFontSize();
}

TextLine force_line(const ToolState& tool) {
    const double force_n = glm::length(tool.force_n);
    if (!tool.shank_torque_n_mm) return {{Tone::plain, trf("force on the hand {:.2f} N", force_n)}};
    return {{Tone::plain,
             trf("force {:.2f} N, shank torque {:.1f} N mm", force_n, glm::length(*tool.shank_torque_n_mm))}};
}

std::string depth_text(const ToolState& tool) {
    if (!tool.depth_mm) return tr("depth: this server does not say");
    return *tool.depth_mm > 0.0 ? trf("depth {:.2f} mm", *tool.depth_mm) : tr("depth: not in bone");
}

TextLine solve_line(const ToolState& tool) {
    if (!tool.solve) return {{Tone::dim, tr("solve: this server does not say")}};
    const SolveCounts& solve = *tool.solve;
    const bool is_poor = solve.max_residual_n > 1e-3 || solve.relaxed > 0;
    return {{is_poor ? Tone::warning : Tone::dim,
             trf("solve {:.1f} mN, {} damped, {} fallbacks", 1e3 * solve.max_residual_n, solve.damped,
                 solve.fallbacks)}};
}

}  // namespace

glm::vec2 live_plot_size(const PanelPainter& painter, PlotDetail detail, bool shows_solve) {
    const float font = ImGui::GetFontSize();
    glm::vec2 size(20.0f * font, 2.0f * painter.line_height());
    if (detail != PlotDetail::numbers) size.y += force_plot_height(detail) + 1.3f * font;
    if (detail == PlotDetail::all)
        size.y += (shows_solve ? painter.line_height() : 0.0f) +
                  2.0f * (painter.line_height() + small_plot_height() + 0.3f * font);
    return glm::ceil(size + 2.0f * painter.padding());
}

void draw_live_plot(const PanelPainter& painter, const ToolHistory& history, const ToolState& tool,
                    PlotDetail detail, bool shows_solve, const PanelPlace& place) {
    painter.draw_background(place);
    PlotColumn column(painter, place);
    column.write(force_line(tool));
    TextLine components;
    for (int axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::size_t>(axis);
        components.push_back(
            {axis_tones[index], spoken_number("{} {:+.2f}   ", tr(axis_names[index]), tool.force_n[axis])});
    }
    column.write(components);
    if (detail == PlotDetail::numbers) return;

    const std::vector<Line> forces = force_lines(history);
    column.plot(forces, range_of(forces, smallest_force_n), force_plot_height(detail));
    if (detail == PlotDetail::all) {
        column.write({{Tone::depth, depth_text(tool)}});
        const std::vector<Line> depth{
            line_of(history, Tone::depth, [](const auto& sample) { return sample.depth_mm; })};
        column.plot(depth, range_of(depth, smallest_depth_mm), small_plot_height());
        column.write({{Tone::removed, trf("removed {:.2f} mm\u00b3", tool.removed_mm3)}});
        const std::vector<Line> removed{line_of(
            history, Tone::removed, [](const auto& sample) { return std::optional(sample.removed_mm3); })};
        column.plot(removed, range_of(removed, smallest_volume_mm3), small_plot_height());
    }
    column.write_times();
    if (detail == PlotDetail::all && shows_solve) column.write(solve_line(tool));
}

PlotRange plot_range(double least, double most, double smallest_span) {
    PlotRange range{std::min(least, 0.0), std::max(most, 0.0)};
    if (range.high > 0.0) range.high = round_number_from(range.high);
    if (range.low < 0.0) range.low = -round_number_from(-range.low);
    if (range.high - range.low >= smallest_span) return range;
    if (range.low < 0.0 && range.high > 0.0) {
        const double half = round_number_from(0.5 * smallest_span);
        return {std::min(range.low, -half), std::max(range.high, half)};
    }
    return range.low < 0.0 ? PlotRange{-smallest_span, 0.0} : PlotRange{0.0, smallest_span};
}

std::vector<glm::vec2> plot_points(std::span<const PlotSample> samples, double span_s, const PlotRange& range,
                                   const glm::vec2& size) {
    const auto place = [&](const PlotSample& sample) {
        const double part = (sample.value - range.low) / (range.high - range.low);
        return glm::vec2(size.x * static_cast<float>(1.0 - sample.age_s / span_s),
                         size.y * static_cast<float>(1.0 - std::clamp(part, 0.0, 1.0)));
    };
    std::vector<glm::vec2> points;
    for (std::size_t first = 0; first < samples.size();) {
        if (samples[first].age_s > span_s) {
            ++first;
            continue;
        }
        const float column = std::floor(place(samples[first]).x);
        std::size_t least = first, greatest = first, next = first + 1;
        for (; next < samples.size() && std::floor(place(samples[next]).x) == column; ++next) {
            if (samples[next].value < samples[least].value) least = next;
            if (samples[next].value > samples[greatest].value) greatest = next;
        }
        points.push_back(place(samples[std::min(least, greatest)]));
        if (least != greatest) points.push_back(place(samples[std::max(least, greatest)]));
        first = next;
    }
    return points;
}

}  // namespace osteomill
