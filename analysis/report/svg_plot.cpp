#include "analysis/report/svg_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "analysis/report/page_style.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

constexpr double width = 900.0;
constexpr double height = 210.0;
constexpr double left = 62.0;
constexpr double right = 14.0;
constexpr double top = 30.0;
constexpr double bottom = 40.0;
/// Colours that the colour-blind can tell apart, too (Okabe and Ito, 2008).
constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                             "#e69f00", "#56b4e9", "#333333"};

constexpr double legend_row = 18.0;

const char* colour_of(std::size_t line) {
    return colours[line % colours.size()];
}

/// Dashes tell lines apart once the colours begin anew.
const char* dashes_of(std::size_t line) {
    constexpr std::array<const char*, 3> dashes{"", " stroke-dasharray='7 3'", " stroke-dasharray='2 3'"};
    return dashes[line / colours.size() % dashes.size()];
}

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void hold(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen() {
        if (!(low <= high)) low = 0.0, high = 1.0;
        if (high - low < 1e-9 * std::max(1.0, std::abs(high)))
            high = low + (low == 0.0 ? 1.0 : std::abs(low));
    }
};

/// 1, 2 or 5 times a power of ten, for four to ten steps.
double tick_step(const Range& range) {
    const double rough = (range.high - range.low) / 5.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (rough <= factor * power) return factor * power;
    return 10.0 * power;
}

struct Axes {
    Range x;
    Range y;

    double px(double value) const {
        return left + (value - x.low) / (x.high - x.low) * (width - left - right);
    }
    double py(double value) const {
        return height - bottom - (value - y.low) / (y.high - y.low) * (height - top - bottom);
    }
};

struct Dot {
    double x;
    double y;
};

std::vector<Dot> visible(const PlotLine& line, const Axes& axes) {
    std::vector<Dot> dots;
    const std::size_t count = std::min(line.x.size(), line.y.size());
    double column = -1.0;
    Dot least{};
    Dot greatest{};
    const auto flush = [&] {
        if (column < 0.0) return;
        const bool in_order = least.x <= greatest.x;
        dots.push_back(in_order ? least : greatest);
        if (least.x != greatest.x || least.y != greatest.y) dots.push_back(in_order ? greatest : least);
    };
    for (std::size_t i = 0; i < count; ++i) {
        if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) continue;
        const Dot dot{axes.px(line.x[i]), axes.py(line.y[i])};
        if (std::floor(dot.x) != column) {
            flush();
            column = std::floor(dot.x);
            least = greatest = dot;
        }
        if (dot.y < least.y) least = dot;
        if (dot.y > greatest.y) greatest = dot;
    }
    flush();
    return dots;
}

std::string tick_text(double value, double step) {
    return spoken_number("{:g}", std::abs(value) < 1e-9 * step ? 0.0 : value);
}

void add_axes(std::string& svg, const SvgPlot& plot, const Axes& axes) {
    const double y_step = tick_step(axes.y);
    for (double y = std::ceil(axes.y.low / y_step) * y_step; y <= axes.y.high + 1e-9 * y_step; y += y_step)
        svg += fmt::format(
            "<path d='M{:.1f} {:.1f}H{:.1f}' stroke='#e3e3e3'/><text x='{:.1f}' y='{:.1f}' "
            "text-anchor='end'>{}</text>",
            left, axes.py(y), width - right, left - 6.0, axes.py(y) + 4.0, tick_text(y, y_step));
    const double x_step = tick_step(axes.x);
    for (double x = std::ceil(axes.x.low / x_step) * x_step; x <= axes.x.high + 1e-9 * x_step; x += x_step)
        svg += fmt::format(
            "<path d='M{0:.1f} {1:.1f}v5' stroke='#888'/><text x='{0:.1f}' y='{2:.1f}' "
            "text-anchor='middle'>{3}</text>",
            axes.px(x), height - bottom, height - bottom + 18.0, tick_text(x, x_step));
    svg +=
        fmt::format("<path d='M{:.1f} {:.1f}H{:.1f}' stroke='#888'/>", left, height - bottom, width - right);
    svg += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>",
                       0.5 * (left + width - right), height - 6.0, html_text(plot.x_text));
    svg += fmt::format("<text x='{:.1f}' y='16' class='title'>{}</text>", left, html_text(plot.title));
    svg += fmt::format("<text transform='translate(14 {:.1f}) rotate(-90)' text-anchor='middle'>{}</text>",
                       0.5 * (top + height - bottom), html_text(plot.y_text));
}

void add_line(std::string& svg, const PlotLine& line, const Axes& axes, std::size_t number) {
    const char* const colour = colour_of(number);
    const std::vector<Dot> dots = visible(line, axes);
    if (dots.empty()) return;
    svg +=
        fmt::format("<polyline fill='none' stroke='{}' stroke-width='1.5' stroke-linejoin='round'{} points='",
                    colour, dashes_of(number));
    for (const Dot& dot : dots) svg += fmt::format("{:.1f},{:.1f} ", dot.x, dot.y);
    svg += "'/>";
    if (dots.size() == 1)
        for (const Dot& dot : dots)
            svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.5' fill='{}'/>", dot.x, dot.y, colour);
}

void add_moment(std::string& svg, const PlotMoment& moment, double x) {
    const bool is_right = x > 0.75 * width;
    svg += fmt::format(
        "<path d='M{0:.1f} {1:.1f}V{2:.1f}' stroke='#b00' stroke-dasharray='4 3'/><text x='{3:.1f}' "
        "y='{4:.1f}' "
        "fill='#b00' font-size='11' text-anchor='{5}'>{6}</text>",
        x, top, height - bottom, is_right ? x - 3.0 : x + 3.0, top + 9.0, is_right ? "end" : "start",
        html_text(moment.text));
}

/// Width of the name's dash and text; an estimate, since no font is measured here.
double legend_width(const PlotLine& line) {
    return 7.0 * static_cast<double>(line.name.size()) + 24.0;
}

void add_legend_entry(std::string& svg, const SvgPlot& plot, std::size_t i, double x, double y) {
    svg += fmt::format(
        "<path d='M{0:.1f} {1:.1f}h14' stroke='{2}' stroke-width='3'{3}/><text x='{4:.1f}' y='{5:.1f}'>"
        "{6}</text>",
        x, y - 4.0, colour_of(i), dashes_of(i), x + 18.0, y, html_text(plot.lines[i].name));
}

/// Beside the title if it fits there, else in rows below the plot. Returns the height of these rows.
double add_legend(std::string& svg, const SvgPlot& plot) {
    if (plot.lines.size() < 2) return 0.0;
    double all = 0.0;
    for (const PlotLine& line : plot.lines) all += legend_width(line);
    if (left + 8.0 * static_cast<double>(plot.title.size()) + all < width - right) {
        double x = width - right - all;
        for (std::size_t i = 0; i < plot.lines.size(); ++i) {
            add_legend_entry(svg, plot, i, x, 16.0);
            x += legend_width(plot.lines[i]);
        }
        return 0.0;
    }
    double x = left;
    double below = legend_row;
    for (std::size_t i = 0; i < plot.lines.size(); ++i) {
        if (x > left && x + legend_width(plot.lines[i]) > width - right) {
            x = left;
            below += legend_row;
        }
        add_legend_entry(svg, plot, i, x, height + below - 4.0);
        x += legend_width(plot.lines[i]);
    }
    return below;
}

}  // namespace

std::string to_svg(const SvgPlot& plot) {
    Axes axes;
    for (const PlotLine& line : plot.lines)
        for (std::size_t i = 0; i < std::min(line.x.size(), line.y.size()); ++i)
            if (std::isfinite(line.x[i]) && std::isfinite(line.y[i])) {
                axes.x.hold(line.x[i]);
                axes.y.hold(line.y[i]);
            }
    if (plot.y_from_zero) axes.y.hold(0.0);
    axes.x.widen();
    axes.y.widen();
    const double room = 0.04 * (axes.y.high - axes.y.low);
    axes.y.high += room;
    if (axes.y.low != 0.0) axes.y.low -= room;
    std::string svg = fmt::format("<title>{}</title>", html_text(plot.title));
    add_axes(svg, plot, axes);
    for (const PlotMoment& moment : plot.moments)
        if (moment.x >= axes.x.low && moment.x <= axes.x.high) add_moment(svg, moment, axes.px(moment.x));
    for (std::size_t i = 0; i < plot.lines.size(); ++i) add_line(svg, plot.lines[i], axes, i);
    const double legend_height = add_legend(svg, plot);
    return fmt::format(
        "<svg viewBox='0 0 {:g} {:g}' xmlns='http://www.w3.org/2000/svg' role='img' "
        "font-family='sans-serif' font-size='12' fill='#333'>{}</svg>",
        width, height + legend_height, svg);
}

}  // namespace osteomill
