#include "render_client/volume/passes/stereo_picture.h"

#include <algorithm>
#include <glm/common.hpp>

#include "render_client/volume/shaders/shader_files.h"

namespace osteomill {

namespace {

double part_of_frame(StereoLayout layout) {
    return layout == StereoLayout::off ? 1.0 : 0.5;
}

gl::Framebuffer black_picture(const glm::ivec2& size_px) {
    gl::Framebuffer picture(size_px);
    picture.bind();
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    return picture;
}

}  // namespace

StereoPicture::StereoPicture(BoneRenderer& renderer, const glm::ivec2& size_px, bool on_demand,
                             const StereoSettings& stereo)
    : renderer_(renderer),
      stereo_(stereo),
      size_px_(glm::max(size_px, 1)),
      left_(renderer, osteomill::eye_size_px(stereo.layout, size_px_), on_demand ? &left_timer_ : nullptr,
            part_of_frame(stereo.layout) * target_frame_s) {
    if (stereo.layout != StereoLayout::off)
        right_.emplace(renderer, left_.size_px(), on_demand ? &right_timer_ : nullptr,
                       part_of_frame(stereo.layout) * target_frame_s);
    if (is_composed()) whole_ = black_picture(size_px_);
    if (stereo.layout == StereoLayout::rows) interleave_ = make_program(interleave_rows_files);
    note_pictures();
}

bool StereoPicture::is_composed() const {
    return stereo_.layout != StereoLayout::off && stereo_.layout != StereoLayout::quad_buffer;
}

void StereoPicture::note_pictures() {
    pictures_ = {&left_.framebuffer()};
    if (right_) pictures_.push_back(&right_->framebuffer());
}

void StereoPicture::resize(const glm::ivec2& size_px) {
    const glm::ivec2 size = glm::max(size_px, 1);
    if (size == size_px_) return;
    size_px_ = size;
    left_.resize(osteomill::eye_size_px(stereo_.layout, size));
    if (right_) right_->resize(left_.size_px());
    if (is_composed()) whole_ = black_picture(size_px_);
    note_pictures();
}

void StereoPicture::set_appearance(const SceneAppearance& look) {
    // Both eyes share the renderer: the second would find the new appearance set and see no change.
    const bool is_new = !(look == renderer_.look());
    left_.set_appearance(look);
    if (is_new && right_) right_->forget_bone();
}

void StereoPicture::forget_bone(DrawingCost cost) {
    left_.forget_bone(cost);
    if (right_) right_->forget_bone(cost);
}

std::size_t StereoPicture::add_structure(const StructureSurface& surface, double opacity) {
    if (right_) right_->add_structure(surface, opacity);
    return left_.add_structure(surface, opacity);
}

void StereoPicture::show_structure(std::size_t structure, bool is_shown) {
    left_.show_structure(structure, is_shown);
    if (right_) right_->show_structure(structure, is_shown);
}

void StereoPicture::forget_structures() {
    left_.forget_structures();
    if (right_) right_->forget_structures();
}

void StereoPicture::mark_dirty(const BoneTextures& bone, std::span<const VoxelBox> changed) {
    left_.mark_dirty(bone, changed);
    if (right_) right_->mark_dirty(bone, changed);
}

void StereoPicture::frame_took(double frame_s) {
    const double part = part_of_frame(stereo_.layout);
    left_.frame_took(part * frame_s);
    if (right_) right_->frame_took(part * frame_s);
}

PictureQuality StereoPicture::quality() const {
    const PictureQuality left = left_.quality();
    if (!right_) return left;
    const PictureQuality right = right_->quality();
    return {std::min(left.scale, right.scale), left.refined && right.refined};
}

void StereoPicture::draw(const BoneTextures* bone, const DrawnTool* tool, const Camera& middle) {
    if (!right_) {
        left_.draw(bone, tool, middle);
        return;
    }
    left_.draw(bone, tool, eye_camera(middle, stereo_, Eye::left));
    right_->draw(bone, tool, eye_camera(middle, stereo_, Eye::right));
}

void StereoPicture::cover(std::span<const PixelBox> boxes) {
    left_.cover(boxes);
    if (right_) right_->cover(boxes);
}

const gl::Framebuffer& StereoPicture::compose() {
    if (!whole_) {
        left_.framebuffer().bind();
        return left_.framebuffer();
    }
    const gl::Framebuffer& left = left_.framebuffer();
    const gl::Framebuffer& right = right_->framebuffer();
    const glm::ivec2 rest = size_px_ - left.size_px();
    if (stereo_.layout == StereoLayout::side_by_side) {
        left.copy_colour_to(*whole_, {0, 0});
        right.copy_colour_to(*whole_, {rest.x, 0});
    } else if (stereo_.layout == StereoLayout::top_bottom) {
        left.copy_colour_to(*whole_, {0, rest.y});
        right.copy_colour_to(*whole_, {0, 0});
    } else {
        whole_->bind();
        left.bind_textures(0);
        right.bind_textures(2);
        interleave_->use();
        interleave_->set("left_eye", 0);
        interleave_->set("right_eye", 2);
        interleave_->set("height", size_px_.y);
        glDisable(GL_DEPTH_TEST);
        interleave_->fill_picture();
        glEnable(GL_DEPTH_TEST);
    }
    whole_->bind();
    return *whole_;
}

void StereoPicture::copy_to_window() const {
    if (stereo_.layout == StereoLayout::quad_buffer) {
        left_.framebuffer().copy_colour_to_window(GL_BACK_LEFT);
        right_->framebuffer().copy_colour_to_window(GL_BACK_RIGHT);
    } else {
        (whole_ ? *whole_ : left_.framebuffer()).copy_colour_to_window();
    }
}

}  // namespace osteomill
