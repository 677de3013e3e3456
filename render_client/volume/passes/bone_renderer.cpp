#include "render_client/volume/passes/bone_renderer.h"

#include "render_client/volume/passes/raycast_renderer.h"
#include "render_client/volume/passes/slice_renderer.h"

namespace osteomill {

std::unique_ptr<BoneRenderer> make_renderer(RendererChoice choice) {
    if (choice == RendererChoice::slices) return std::make_unique<SliceRenderer>();
    return std::make_unique<RaycastRenderer>();
}

}  // namespace osteomill
