// A table of 256 colours and opacities in a texture of 256 x 1 texels: what a byte code looks like. A
// move-only value.
#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "render_client/volume/gl/name.h"

namespace osteomill::gl {

class LookupTable {
  public:
    /// Linear RGB and opacity by code, stored as GL_RGBA32F; read by texelFetch(sampler2D, ivec2(code, 0),
    /// 0).
    explicit LookupTable(const std::array<glm::vec4, 256>& look_by_code);

    void bind(int unit) const;

  private:
    TextureName id_;
};

}  // namespace osteomill::gl
