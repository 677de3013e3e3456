// Textures in 2D and 3D: move-only values. Every call needs the OpenGL context in which they were made to
// be current.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <stdexcept>

#include "render_client/volume/gl/name.h"
#include "render_client/volume/picture.h"

namespace osteomill::gl {

/// Storage of a texel and interpolation between texels. Outside the texture every read gives zero.
enum class VoxelFormat {
    interpolated_byte,   ///< GL_R8, read as 0 to 1, trilinear
    interpolated_bytes,  ///< GL_RG8, two of them
    interpolated_rgba,   ///< GL_RGBA8, four of them
    byte_code,           ///< GL_R8UI, read as a whole number by texelFetch
    byte_codes           ///< GL_RGBA8UI, four of them
};

/// The driver has no memory for a texture, or allows none of that size. The message gives the size.
struct NoTextureMemory : std::runtime_error {
    using std::runtime_error::runtime_error;
};

class Texture3D {
  public:
    /// Storage for `size` texels, contents undefined. Throws NoTextureMemory.
    Texture3D(VoxelFormat format, const glm::ivec3& size);

    /// Its outermost texels go on beyond it; without this call, it is zero there. Mesa's software rasteriser
    /// then interpolates in bytes, with weights of eight bits, which takes it less time.
    void end_at_edges();

    /// glTexSubImage3D: the bytes of each texel, x fastest. The box must lie within the texture.
    void upload(const glm::ivec3& first, const glm::ivec3& size, std::span<const std::uint8_t> texels);
    /// glGetTexImage: the whole texture, the bytes of each texel, x fastest.
    void read_back(std::span<std::uint8_t> texels) const;
    /// Binds to GL_TEXTURE0 + unit.
    void bind(int unit) const;
    /// Unbinds any 3D texture from GL_TEXTURE0 + unit.
    static void unbind(int unit);
    /// Unbinds them from every unit that a program is sure to have.
    static void unbind_all();

    const glm::ivec3& size() const { return size_; }
    /// Bytes as requested of the driver.
    std::size_t bytes() const;

  private:
    TextureName id_;
    VoxelFormat format_;
    glm::ivec3 size_;
};

/// GL_MAX_3D_TEXTURE_SIZE of the current context.
int max_texture3d_edge();

/// A 2D texture: a move-only value. Every call needs the OpenGL context in which it was made to be current.
class Texture2D {
  public:
    /// glTexImage2D, which replaces the texels: rows of `texels` follow one another without a gap, null
    /// leaves them undefined. The filter is `smaller` if a pixel covers several texels, else `larger`.
    void store(const glm::ivec2& size, GLint stored_as, GLenum format, GLenum type, const void* texels,
               GLint smaller, GLint larger);
    /// GL_CLAMP_TO_EDGE: beyond its edges the edges go on.
    void end_at_edges();
    /// A picture, to be shown as it is: rows from the top.
    void upload(const Picture& picture);
    void upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba);
    /// Binds to GL_TEXTURE0 + unit.
    void bind(int unit) const;
    GLuint id() const { return id_; }

  private:
    TextureName id_;
};

}  // namespace osteomill::gl
