#include "render_client/volume/renderer_choice.h"

#include "render_client/volume/raycast_renderer.h"
#include "render_client/volume/slice_renderer.h"

namespace osteomill {

std::unique_ptr<BoneRenderer> make_renderer(RendererChoice choice) {
    if (choice == RendererChoice::slices) return std::make_unique<SliceRenderer>();
    return std::make_unique<RaycastRenderer>();
}

}  // namespace osteomill
