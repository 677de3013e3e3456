// A cube that turns with the view and names the patient's sides: L and R, A and P, S and I.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render_client/ui/panels/panel_painter.h"
#include "render_client/volume/camera.h"

namespace osteomill {

/// A face that is turned towards the eye, in a square of side 1 whose y goes down; the cube's middle is at
/// (0.5, 0.5), and all of it fits inside however it is turned.
struct CubeFace {
    char letter = ' ';
    glm::dvec3 outward{0.0};  ///< unit, patient LPS
    double facing = 0.0;      ///< 0 seen from the edge to 1 seen straight
    std::array<glm::dvec2, 4> corners;
    glm::dvec2 middle{0.0};
};

/// The one to three faces that can be seen, without perspective.
std::vector<CubeFace> visible_faces(const Camera& camera);

/// Which of them holds a point of the square; none beside the cube.
std::optional<CubeFace> face_at(const Camera& camera, const glm::dvec2& point);

/// Turns the camera until it looks straight at the side of the patient that `outward` names.
void look_at_side(Camera& camera, const glm::dvec3& outward);

// The orientation cube over the picture; a click on a face turns the view to it.

glm::vec2 cube_size(const PanelPainter& painter);
void draw_cube(const PanelPainter& painter, Camera& camera, const PanelPlace& place);

}  // namespace osteomill
