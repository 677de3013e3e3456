#include "render_client/volume/gl/texture.h"

#include <stdexcept>

#include "render_client/volume/gl/gl_error.h"

namespace osteomill::gl {

namespace {

struct TexelFormat {
    GLenum stored;
    GLenum transferred;
    GLint filter;
    std::size_t bytes;
};

TexelFormat texel_format(VoxelFormat format) {
    switch (format) {
        case VoxelFormat::interpolated_bytes:
            return {GL_RG8, GL_RG, GL_LINEAR, 2};
        case VoxelFormat::interpolated_rgba:
            return {GL_RGBA8, GL_RGBA, GL_LINEAR, 4};
        case VoxelFormat::byte_code:
            return {GL_R8UI, GL_RED_INTEGER, GL_NEAREST, 1};
        case VoxelFormat::byte_codes:
            return {GL_RGBA8UI, GL_RGBA_INTEGER, GL_NEAREST, 4};
        case VoxelFormat::interpolated_byte:
            break;
    }
    return {GL_R8, GL_RED, GL_LINEAR, 1};
}

std::size_t byte_count(const glm::ivec3& size, VoxelFormat format) {
    return texel_format(format).bytes * static_cast<std::size_t>(size.x) * size.y * size.z;
}

}  // namespace

Texture3D::Texture3D(VoxelFormat format, const glm::ivec3& size) : format_(format), size_(size) {
    const TexelFormat texels = texel_format(format);
    glBindTexture(GL_TEXTURE_3D, id_);
    // While memory is made the other way, Mesa blocks every context of the program from textures.
    if (epoxy_gl_version() >= 42 || epoxy_has_gl_extension("GL_ARB_texture_storage"))
        glTexStorage3D(GL_TEXTURE_3D, 1, texels.stored, size.x, size.y, size.z);
    else
        glTexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(texels.stored), size.x, size.y, size.z, 0,
                     texels.transferred, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, texels.filter);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, texels.filter);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_BORDER);
    try {
        require_no_gl_error("making a 3D texture of " + std::to_string(size.x) + " x " +
                            std::to_string(size.y) + " x " + std::to_string(size.z) + " texels");
    } catch (const std::runtime_error& error) {
        throw NoTextureMemory(error.what());
    }
}

void Texture3D::end_at_edges() {
    glBindTexture(GL_TEXTURE_3D, id_);
    for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R})
        glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_3D, 0);
}

void Texture3D::upload(const glm::ivec3& first, const glm::ivec3& size,
                       std::span<const std::uint8_t> texels) {
    const std::size_t needed = byte_count(size, format_);
    if (texels.size() != needed) throw std::invalid_argument("a texture upload of the wrong length");
    glBindTexture(GL_TEXTURE_3D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexSubImage3D(GL_TEXTURE_3D, 0, first.x, first.y, first.z, size.x, size.y, size.z,
                    texel_format(format_).transferred, GL_UNSIGNED_BYTE, texels.data());
}

void Texture3D::read_back(std::span<std::uint8_t> texels) const {
    if (texels.size() != byte_count(size_, format_))
        throw std::invalid_argument("a texture read-back of the wrong length");
    glBindTexture(GL_TEXTURE_3D, id_);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTexImage(GL_TEXTURE_3D, 0, texel_format(format_).transferred, GL_UNSIGNED_BYTE, texels.data());
}

std::size_t Texture3D::bytes() const {
    return byte_count(size_, format_);
}

void Texture3D::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_3D, id_);
}

void Texture3D::unbind(int unit) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_3D, 0);
}

void Texture3D::unbind_all() {
    constexpr int units = 16;  // of a fragment shader, at the least
    for (int unit = 0; unit < units; ++unit) unbind(unit);
}

int max_texture3d_edge() {
    GLint edge = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &edge);
    return edge;
}

void Texture2D::store(const glm::ivec2& size, GLint stored_as, GLenum format, GLenum type, const void* texels,
                      GLint smaller, GLint larger) {
    glBindTexture(GL_TEXTURE_2D, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, stored_as, size.x, size.y, 0, format, type, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, larger);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2D::end_at_edges() {
    glBindTexture(GL_TEXTURE_2D, id_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glBindTexture(GL_TEXTURE_2D, 0);
}

void Texture2D::upload(const Picture& picture) {
    store(picture.size_px, GL_RGBA8, GL_RGB, GL_UNSIGNED_BYTE, picture.rgb.data(), GL_LINEAR, GL_NEAREST);
}

void Texture2D::upload(const glm::ivec2& size_px, std::span<const std::uint8_t> rgba) {
    store(size_px, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data(), GL_LINEAR, GL_NEAREST);
}

void Texture2D::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(GL_TEXTURE_2D, id_);
}

}  // namespace osteomill::gl
