// A wall cut by a spherical burr, drawn by the product and analytically: a cut is to look as smooth as the
// sphere that cut it. Nothing of the analytic picture comes from voxels but the ambient light.
#pragma once

namespace osteomill::study {

/// PSNR of the picture of such a wall, 160 x 160 pixels, against the analytic one, dB. Needs a current OpenGL
/// context.
double carved_sphere_psnr_db(double px_per_voxel);

/// 95th percentile of the angle between the wall's normals as the shaders take them and the sphere's,
/// degrees.
double carved_sphere_normals_p95_deg();

}  // namespace osteomill::study
