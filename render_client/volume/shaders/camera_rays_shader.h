// The vertex shader of whatever looks along a camera's rays: one triangle over the whole picture
// (FullScreen), GLSL 3.30.
#pragma once

namespace osteomill {

inline constexpr const char* camera_rays_vertex_glsl = R"glsl(#version 330 core
uniform vec3 forward, right, up;  // right and up reach from the picture's middle to its edge at distance 1
out vec3 ray;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    ray = forward + corner.x * right + corner.y * up;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)glsl";

}  // namespace osteomill
