#include "analysis/report/page_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "analysis/report/headlines.h"
#include "analysis/report/metrics_csv_json.h"
#include "common/words/translation.h"

namespace osteomill {

const char* const page_style = R"(
@page{margin:12mm}
*{box-sizing:border-box}
body{font:14px/1.4 "Helvetica Neue",Arial,"Liberation Sans",sans-serif;color:#222;max-width:1000px;margin:0 auto;padding:20px}
h1{font-size:24px;margin:0 0 2px}h2{font-size:17px;margin:26px 0 8px;border-bottom:2px solid #0072b2;padding-bottom:3px}
p.about{color:#555;margin:2px 0}p.wrong{background:#fdecea;border-left:4px solid #b00;padding:8px 12px}
.verdict{border-left:6px solid #888;background:#f3f6f9;padding:8px 14px;margin:12px 0}.verdict b{font-size:19px;margin-right:10px}
.verdict.passed{border-color:#007a4d;background:#e8f5ee}.verdict.failed{border-color:#b00;background:#fdecea}.verdict.touched{border-color:#b26a00;background:#fff4e0}
.verdict b.undone{font-size:inherit;color:#b00}.source{display:block;color:#777;font-size:12px}code{font-size:11.5px;overflow-wrap:anywhere}
.tiles{display:grid;grid-template-columns:repeat(3,1fr);gap:8px;margin:12px 0}
.tile{background:#f3f6f9;border-radius:4px;padding:7px 12px;border-left:4px solid #c9d3dc}
.tile.reached{border-color:#007a4d}.tile.missed{border-color:#b00;background:#fdecea}
.tile b{font-size:21px}.tile span{display:block;color:#555;font-size:12.5px}.tile svg{margin:3px 0 0;display:block}
table{border-collapse:collapse;margin:6px 0 12px;width:100%}td,th{padding:2px 8px;text-align:left;border-bottom:1px solid #e6e6e6}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums}td.u{color:#777;padding-left:0}th{color:#555;font-weight:600}
th{vertical-align:bottom}td.w{white-space:nowrap}td.setting{overflow-wrap:anywhere}td.yes{color:#007a4d}td.no{color:#b00}
.columns{columns:2;column-gap:36px}.columns section{break-inside:avoid}h3{font-size:15px;margin:14px 0 2px}
.pictures{display:grid;grid-template-columns:repeat(3,1fr);gap:12px}.pictures.two{grid-template-columns:repeat(2,1fr)}
figure{margin:0}figure img{width:100%;display:block;border:1px solid #ddd}figcaption{font-size:12.5px;color:#555}
.seen{position:relative}.seen svg{position:absolute;left:0;top:0;height:100%;margin:0}
svg{width:100%;height:auto;margin:4px 0}svg .title{font-weight:600}
.swatch{display:inline-block;width:11px;height:11px;border-radius:2px;border:1px solid #999;margin:0 5px 0 0}
.entry{white-space:nowrap;margin-right:14px}
.comment{border:1px solid #999;min-height:110px;padding:4px 10px;margin:10px 0 0;color:#555;font-size:12.5px;flex:1}
.signatures{display:grid;grid-template-columns:repeat(3,1fr);gap:24px;margin-top:34px}
.signatures div{border-top:1px solid #444;color:#555;font-size:12.5px;padding-top:2px}
footer{color:#777;font-size:12.5px;margin-top:30px}
p,h1,h2,h3,.verdict,.tile,figcaption{overflow-wrap:break-word}
@media screen{.scroll{overflow-x:auto;max-width:100%}td>code{display:block;min-width:130px}}
@media screen and (max-width:940px){.columns{columns:1}.tiles,.pictures,.pictures.two{grid-template-columns:repeat(2,minmax(0,1fr))}}
@media screen and (max-width:480px){.tiles,.pictures,.pictures.two,.signatures{grid-template-columns:minmax(0,1fr)}}
@media print{body{max-width:none;padding:0;font-size:11px;print-color-adjust:exact;-webkit-print-color-adjust:exact}
.first{display:flex;flex-direction:column;height:252mm;break-after:page}
.first .two{width:124mm;margin:0 auto}.first .verdict,.first .tiles{margin:5px 0}.comment{min-height:18mm}.signatures{margin-top:24px}
h2,h3{break-after:avoid}figure,svg,tr,section{break-inside:avoid}figcaption,.tile span,.comment,.signatures div,footer{font-size:9.5px}
.wide{font-size:9px}.wide td,.wide th{padding:2px 4px}}
)";

namespace {

std::string number_with_point(double value) {
    const double size = std::abs(value);
    if (size >= 1000.0) return fmt::format("{:.0f}", value);
    if (size >= 100.0) return fmt::format("{:.1f}", value);
    if (size == 0.0 || size == std::round(size)) return fmt::format("{:g}", value);
    if (size >= 0.01) return fmt::format("{:.{}f}", value, size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3);
    return fmt::format("{:.2g}", value);
}

}  // namespace

std::string number_text(double value, std::string_view unit) {
    if (!std::isfinite(value)) return "–";
    // Nobody reads 1.8e-05 %.
    const bool is_tiny_share = unit == "%" && std::abs(value) < 0.01;
    return with_decimal_sign(number_with_point(is_tiny_share ? 0.0 : value));
}

std::string shown_unit(std::string_view unit) {
    return unit == "mm^3" ? "mm³" : unit == "deg" ? "°" : std::string(unit);
}

ShownValue shown_value(std::string_view key, double value, std::string_view unit) {
    if (const Headline* known = headline(key))
        return {number_text(known->scale * value, known->unit), known->unit};
    return {number_text(value), shown_unit(unit)};
}

std::string local_time_text(std::int64_t unix_ns, const std::string& language) {
    if (began_text(unix_ns).empty()) return {};
    const auto unix_s = static_cast<std::time_t>(unix_ns / 1'000'000'000);
    std::tm local{};
    std::array<char, 64> text{};
    if (localtime_r(&unix_s, &local) == nullptr) return {};
    const char* const form = language == "de" ? "%d.%m.%Y, %H:%M Uhr" : "%Y-%m-%d %H:%M %Z";
    return {text.data(), std::strftime(text.data(), text.size(), form, &local)};
}

namespace {

struct Escape {
    char letter;
    const char* written;
};
constexpr std::array escapes{Escape{'&', "&amp;"}, Escape{'<', "&lt;"}, Escape{'>', "&gt;"},
                             Escape{'"', "&quot;"}, Escape{'\'', "&#39;"}};

/// By the library that checks every byte of it anyway.
std::string valid_utf8(std::string_view text) {
    const nlohmann::json quoted(std::string{text});
    return nlohmann::json::parse(quoted.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace))
        .get<std::string>();
}

}  // namespace

std::string html_text(std::string_view text) {
    std::string escaped;
    for (const char letter : valid_utf8(text)) {
        const auto mark = std::ranges::find(escapes, letter, &Escape::letter);
        if (mark != escapes.end())
            escaped += mark->written;
        else
            escaped += static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ? ' ' : letter;
    }
    return escaped;
}

}  // namespace osteomill
