// A triangle over the whole picture (Program::fill_picture), with the camera's ray through each pixel.

uniform vec3 middle_ray, right, up;  // middle_ray is 1 forward; right and up reach from the picture's middle to its edge at distance 1
out vec3 ray;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    ray = middle_ray + corner.x * right + corner.y * up;
    gl_Position = vec4(corner, 0.0, 1.0);
}
