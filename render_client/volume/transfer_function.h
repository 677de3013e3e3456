// A transfer function: colour and opacity of bone by its relative stiffness, along lines between control
// points.
//
// The scene makes stiffness from CT numbers and sends stiffness to the client, so a value is a stiffness: 1
// is cortical bone (1600 HU by the default relation), trabecular bone lies around a tenth, enamel above two.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <span>
#include <string>
#include <vector>

namespace osteomill {

struct TransferPoint {
    double value = 0.0;  ///< relative stiffness
    std::array<std::uint8_t, 3> srgb{};
    double opacity = 1.0;  ///< 0 to 1, see TransferMode

    bool operator==(const TransferPoint&) const = default;
};

/// Meaning of opacity.
enum class TransferMode {
    /// The share of a voxel that counts: bone ends where fraction times opacity crosses one half, and is
    /// solid there. A ramp from 0 to 1 peels off softer bone, smoothly. Fast.
    surface,
    /// The share of light that a millimetre of bone absorbs: bone is seen through, at the price of every
    /// sample on the way. 0 hides.
    translucent
};

struct TransferFunction {
    std::string name;
    TransferMode mode = TransferMode::surface;
    std::vector<TransferPoint> points{};  ///< ascending in value, at least one

    bool operator==(const TransferFunction&) const = default;
};

/// Linear RGB and opacity at a value; the end points hold beyond them. Colours blend in linear light, as the
/// shaders do it.
glm::vec4 look_of(const TransferFunction& function, double value);

/// Throws std::invalid_argument, naming the point, unless there is one, values are finite and ascend, and
/// opacities are within 0 to 1.
void require_valid(const TransferFunction& function);

/// "bone": all bone in its own colours. "tooth": tissue softer than dentine is seen through, enamel and
/// dentine stand in it. "ct-window": grey levels of a bone window.
std::span<const TransferFunction> transfer_presets();

/// A CT window as in radiology, HU: black at centre - width / 2, white at centre + width / 2; bone darker
/// than a fifth of the window is hidden. Stiffness counts as the HU that it has by the default relation; bone
/// has more than 0, and so must the window's upper end. Width is positive.
TransferFunction ct_window(double centre_hu, double width_hu);

}  // namespace osteomill
