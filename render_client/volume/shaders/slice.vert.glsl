// A corner of a view-aligned slice. Lengths are in voxels, in texture coordinates of the bone's box. A slice is drawn half a
// step before its samples: it stands for half a step on either side of them.

layout(location = 0) in vec3 place;
uniform mat4 to_clip;
uniform vec3 eye, forward;
uniform float spacing;
out vec3 sampled;

void main() {
    sampled = place;
    float depth = dot(place - eye, forward);
    gl_Position = to_clip * vec4(eye + (1.0 - 0.5 * spacing / depth) * (place - eye), 1.0);
}
