// The first surface of bone that a pixel's ray meets, as numbers; follows bone_rays.glsl.

uniform mat3 to_camera;        // axes right, down, forward
uniform int thing_number;
layout(location = 0) out vec4 surface;  // xyz the normal, w mm along forward
layout(location = 1) out uint thing;

void main() {
    begin_ray();
    float index = 0.0;
    if (!find_bone(index)) discard;
    float inside = surface_before(index);
    vec3 normal = normal_at(eye + inside * direction, -direction);
    surface = vec4(to_camera * normal, inside * dot(direction, forward) * bone_mm_per_voxel);
    thing = uint(thing_number);
    gl_FragDepth = depth_of(inside);
}
