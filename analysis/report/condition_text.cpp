#include "analysis/report/condition_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "analysis/report/metric_names.h"
#include "common/scene/rating_condition.h"
#include "common/words/translation.h"

namespace osteomill {

namespace {

using Kind = ConditionPiece::Kind;

struct ShownSign {
    std::string_view written;
    const char* shown;
};
constexpr std::array shown_signs{ShownSign{"<=", "≤"}, ShownSign{">=", "≥"}, ShownSign{"==", "="},
                                 ShownSign{"!=", "≠"}, ShownSign{"*", "·"}};

std::string sign_text(const std::string& written) {
    const auto sign = std::ranges::find(shown_signs, written, &ShownSign::written);
    return sign == shown_signs.end() ? written : sign->shown;
}

std::string words_of_key(std::string_view key) {
    const MetricName* const name = metric_name(key);
    if (name == nullptr) return std::string(key);
    const std::string_view millimetres = millimetres_in(key);
    return millimetres.empty() ? tr(name->alone) : trf(name->alone, millimetres);
}

struct ShownUnit {
    std::string name;
    double scale = 1.0;
};

ShownUnit unit_of(std::string_view key) {
    if (key.ends_with("_share")) return {"%", 100.0};
    const MetricName* const name = metric_name(key);
    return {name == nullptr ? "" : shown_unit(name->unit)};
}

class ConditionWriter {
  public:
    explicit ConditionWriter(const std::vector<ConditionPiece>& pieces) : pieces_(pieces) {}

    std::string written() {
        for (std::size_t i = 0; i < pieces_.size(); ++i)
            write(pieces_[i], i + 1 < pieces_.size() ? &pieces_[i + 1] : nullptr);
        return text_;
    }

  private:
    void write(const ConditionPiece& piece, const ConditionPiece* next) {
        switch (piece.kind) {
            case Kind::word:
                add(tr(piece.text));
                compared_.clear();
                is_alone_ = true;
                is_compared_ = false;
                break;
            case Kind::comparison:
                add(sign_text(piece.text));
                is_compared_ = !compared_.empty();
                break;
            case Kind::operation:
                add(sign_text(piece.text));
                if (piece.text == "*" || piece.text == "/") compared_.clear();
                is_compared_ = is_compared_ && piece.text == "-";
                break;
            case Kind::parenthesis:
                add(piece.text);
                is_compared_ = false;
                break;
            case Kind::number:
                write_number(piece.number, next != nullptr && next->kind == Kind::operation);
                break;
            case Kind::quantity:
                add(quantity_text(piece.quantity.key, piece.quantity.of));
                if (is_alone_) compared_ = piece.quantity.key;
                is_alone_ = false;
                is_compared_ = false;
                break;
        }
    }
    void write_number(double number, bool is_reckoned_with) {
        const ShownUnit unit = is_compared_ && !is_reckoned_with ? unit_of(compared_) : ShownUnit{};
        add(ShownValue{spoken_number("{:g}", unit.scale * number), unit.name}.text());
        is_compared_ = false;
    }
    void add(std::string_view piece) {
        const bool is_close = piece == ")" || text_.empty() || text_.ends_with('(');
        text_ += is_close ? "" : " ";
        text_ += piece;
    }

    const std::vector<ConditionPiece>& pieces_;
    std::string text_;
    std::string compared_;      ///< key of the comparison's first quantity, which gives its unit
    bool is_alone_ = true;      ///< no quantity yet in this comparison
    bool is_compared_ = false;  ///< a number here is what the quantity is compared with
};

}  // namespace

std::string quantity_text(std::string_view key, const std::string& of) {
    return of.empty() ? words_of_key(key) : fmt::format("{} ({})", words_of_key(key), tissue_words(of));
}

ShownValue quantity_value(std::string_view key, double value) {
    const ShownUnit unit = unit_of(key);
    return {number_text(unit.scale * value, unit.name), unit.name};
}

std::string condition_text(const std::string& condition) {
    try {
        return ConditionWriter(RatingCondition(condition).pieces()).written();
    } catch (const ConditionError&) {
        return condition;
    }
}

}  // namespace osteomill
