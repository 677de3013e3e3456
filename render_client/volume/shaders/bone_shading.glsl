// Shading of the bone at a point; follows thin_bone.glsl, grain.glsl, sawn_faces.glsl and lighting.glsl.
//
//     vec3  surface_pixel(vec3 point, vec3 direction)   display RGB of the bone's surface at a point, seen
//                                                       along a unit direction
//     vec4  translucent_piece(vec3 point, float length, float through, out float opacity)
//                                                       linear RGB times alpha, and alpha, of so many voxels
//                                                       of a ray around a point within translucent bone, to
//                                                       which that part of light comes through; and the opacity
//                                                       of the tissue there
//     const bool  bone_is_occluded                      given ahead of this file: bone near by takes light away
//     const bool  bone_shines                           given ahead of this file: it has highlights
//     const float bone_surface                          the fraction at which bone begins
//     const float solid_opacity                         translucent bone counts for depth from this opacity
//     on

uniform float specular;

const float bone_surface = 0.5;
const float wet_roughness = 5.0;
const float solid_opacity = 0.5;

vec3 surface_pixel(vec3 point, vec3 direction) {
    if (bone_has_surface_colours) {
        vec4 colour = surface_colour_at(point);
        return colour.rgb / max(colour.a, 1e-3);
    }
    vec3 normal = normal_at(point, -direction);
    float openness = bone_is_occluded ? ambient_occlusion(point, normal) : 1.0;
    vec3 place = place_under(point, normal);
    vec4 behind = bone_shows_through ? look_through(point, direction, place) : vec4(0.0);
    vec3 colour = smooth_look_at(place).rgb;
    float grain = bone_has_grain ? grain_at(point - normal) : 0.0;
    if (bone_has_grain) colour = grained(colour, grain);
    if (bone_shows_through) colour = mix(colour, behind.rgb, behind.a);
    float wet = specular;
    if (bone_has_sawn_faces) {
        float sawn = sawn_share(point);
        colour = mix(colour, sawn_colour(colour), sawn);
        wet *= 1.0 - sawn;
    }
    vec3 light = lit(colour, normal, openness);
    // Pores and pits break the film of water.
    if (bone_shines) light += wet * openness * max(1.0 + wet_roughness * grain, 0.0) * highlight(normal, -direction);
    return display(light);
}

// Slope of the density, which also shows borders between tissues of different opacity: where one sees through bone,
// smoothed fractions count by opacity.
vec3 density_gradient_at(vec3 point) {
    vec3 gradient = vec3(0.0);
    if (bone_has_smoothed) {
        // Four of the eight corners: a ray asks this many times.
        for (int corner = 0; corner < 4; ++corner) {
            vec3 side = side_of_corner((corner << 1) | ((0x6 >> corner) & 1));
            gradient += side * textureLod(bone_smoothed, texture_place_beside(point, corner_reach * side), 0.0).r;
        }
        return gradient / (4.0 * corner_reach);
    }
    for (int corner = 0; corner < 8; ++corner) {
        vec3 side = side_of_corner(corner);
        gradient += side * density_at(point + corner_reach * side);
    }
    return gradient / (8.0 * corner_reach);
}

// Light within bone, which has no facing surface: that on a surface aslant to the key light.
const vec3 light_within = vec3(0.50, 0.49, 0.48);

vec3 translucent_colour(vec3 point, vec3 colour) {
    if (bone_has_surface_colours) {
        vec4 surface = surface_colour_at(point);
        vec3 linear = pow(surface.rgb / max(surface.a, 1e-3), vec3(2.2));
        return mix(colour * light_within, linear, min(2.0 * surface.a, 1.0));
    }
    vec3 gradient = density_gradient_at(point);
    float steepness = length(gradient);
    if (steepness < 1e-4) return colour * light_within;
    return mix(colour * light_within, lit(colour, -gradient / steepness, 1.0), min(12.0 * steepness, 1.0));
}

// Behind the surface bone absorbs light in proportion to the rise of the fraction, so that samples meet no edge.
vec4 translucent_piece(vec3 point, float length_voxels, float through, out float opacity) {
    opacity = 0.0;
    float filled = 2.0 * fraction_at(point) - 1.0;
    if (filled <= 0.0) return vec4(0.0);
    vec4 look = look_at(point);
    opacity = look.a;
    float alpha = 1.0 - pow(1.0 - min(look.a, 0.999), filled * length_voxels * bone_mm_per_voxel);
    // A sample that is hardly seen is not worth its normal.
    vec3 colour = through * alpha < 0.003 * length_voxels ? look.rgb * light_within : translucent_colour(point, look.rgb);
    return vec4(alpha * colour, alpha);
}
