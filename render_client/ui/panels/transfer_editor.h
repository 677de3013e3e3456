// A transfer function while it is being edited: presets to begin with, points to take hold of, move, add and
// remove. It draws nothing: transfer_panel.h does.
#pragma once

#include <cstddef>
#include <optional>

#include "render_client/volume/transfer_function.h"

namespace osteomill {

class TransferEditor {
  public:
    /// Relative stiffness that the editor spans: enamel is at about 2.2.
    static constexpr double highest_value = 3.0;

    TransferEditor() = default;
    explicit TransferEditor(const std::optional<TransferFunction>& begin_with) : function_(begin_with) {}

    /// None: tissues, or stiffness, in their own colours.
    const std::optional<TransferFunction>& function() const { return function_; }
    void choose(const std::optional<TransferFunction>& function);
    void set_mode(TransferMode mode);

    /// The point within reach of (value, opacity), the nearest first; lets go if there is none. Reaches are
    /// half-widths above zero.
    void select_near(double value, double opacity, double value_reach, double opacity_reach);
    std::optional<std::size_t> selected() const { return selected_; }

    // On the selected point; nothing happens without one.
    /// Not past its neighbours; opacity within 0 to 1, value within 0 to highest_value.
    void move(double value, double opacity);
    void set_colour(const std::array<std::uint8_t, 3>& srgb);
    /// The last point stays.
    void remove();

    /// A new point on the line, which changes nothing until it is moved, and is selected.
    void add(double value);

    /// Whether anything changed since the last call: the bone is to be shown otherwise.
    bool take_change();

  private:
    std::optional<TransferFunction> function_;
    std::optional<std::size_t> selected_;
    bool has_changed_ = false;
};

}  // namespace osteomill
