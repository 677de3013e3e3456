// A renderer of soft structures: a mesh for each, in its tissue's colour and opacity, tested against the
// depth of bone and tool, and cut as the bone is.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "render_client/volume/camera.h"
#include "render_client/volume/gl/mesh.h"
#include "render_client/volume/gl/program.h"
#include "render_client/volume/passes/tile_mask.h"
#include "render_client/volume/scene_appearance.h"
#include "render_client/volume/structures/structure_surface.h"

namespace osteomill {

class StructureRenderer {
  public:
    /// Adds a structure, from the next draw on; returns its number. Nothing is drawn of one without
    /// triangles.
    std::size_t add(const StructureSurface& surface, double opacity);
    /// By its number.
    void show(std::size_t structure, bool is_shown) { drawn_[structure].is_shown = is_shown; }
    void forget() { drawn_.clear(); }

    /// Draws over the bound framebuffer, whose depth is that of Camera::projection and whose size that of the
    /// mask; marks the tiles that it may have drawn into.
    void draw(const Camera& camera, const SceneAppearance& look, TileMask& covered);

  private:
    struct Drawn {
        std::optional<gl::Mesh> mesh;  // none: it has no triangles
        glm::dvec3 origin_mm{0.0};
        float opacity = 0.0f;
        bool is_shown = true;
    };

    std::optional<gl::Program> program_;  // none before the first structure
    std::vector<Drawn> drawn_;
};

}  // namespace osteomill
