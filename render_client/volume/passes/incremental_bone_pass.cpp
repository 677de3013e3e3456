#include "render_client/volume/passes/incremental_bone_pass.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "render_client/volume/shaders/bone_program.h"
#include "render_client/volume/shaders/shader_files.h"
#include "render_client/volume/textures/empty_space.h"

namespace osteomill {

namespace {

constexpr int colour_unit = 0;

}  // namespace

Upscaler::Upscaler() : program_(make_program(upscale_files)) {}

void Upscaler::draw(const gl::Framebuffer& coarse, const gl::Framebuffer& fine,
                    std::span<const PixelBox> boxes) const {
    fine.bind();
    coarse.bind_textures(colour_unit);
    program_.use();
    program_.set("colour", colour_unit);
    program_.set("depth", colour_unit + 1);
    program_.set("picture_size", glm::vec2(fine.size_px()));
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glEnable(GL_SCISSOR_TEST);
    for (const PixelBox& box : boxes) {
        glScissor(box.first.x, box.first.y, box.size.x, box.size.y);
        program_.fill_picture();
    }
    glDisable(GL_SCISSOR_TEST);
    glDepthFunc(GL_LESS);
}

namespace {

/// Frames without motion before refining starts: while the view is being turned, some frames see no motion,
/// and pieces that become sharp in them and blurred in the next would flicker.
constexpr int frames_before_refining = 2;

/// Margin of coarse pixels round the needed ones, which interpolation reads.
constexpr int coarse_margin_px = 2;

glm::ivec2 divided(const glm::ivec2& size_px, double divisor) {
    return glm::max(glm::ivec2(glm::ceil(glm::dvec2(size_px) / divisor)), 1);
}

/// The pixels of a coarse picture that are needed to show a box of the fine one.
PixelBox in_coarse(const PixelBox& box, const glm::ivec2& fine_px, const glm::ivec2& coarse_px) {
    const glm::dvec2 ratio = glm::dvec2(coarse_px) / glm::dvec2(fine_px);
    const glm::ivec2 low = glm::ivec2(glm::floor(glm::dvec2(box.first) * ratio)) - coarse_margin_px;
    const glm::ivec2 high =
        glm::ivec2(glm::ceil(glm::dvec2(box.first + box.size) * ratio)) + coarse_margin_px;
    const glm::ivec2 first = glm::max(low, 0);
    return {first, glm::min(high, coarse_px) - first};
}

/// A change affects its whole block: shading reads means over blocks, counted from `origin`.
VoxelBox in_whole_blocks(const VoxelBox& box, const glm::ivec3& origin) {
    const glm::ivec3 first = (box.first - origin) / block_edge_voxels * block_edge_voxels;
    const glm::ivec3 end = box.first + box.size - origin + (block_edge_voxels - 1);
    return {origin + first, end / block_edge_voxels * block_edge_voxels - first};
}

}  // namespace

TileMask tiles_of_changes(std::span<const VoxelBox> changed, const BoneTextures& bone, const Camera& camera,
                          const glm::ivec2& size_px, int reach_voxels) {
    TileMask tiles(size_px);
    const glm::dmat4 to_clip = camera.projection(size_px) * camera.view();
    const double reach = reach_voxels + 0.5;  // a voxel's faces are half a voxel from its centre
    const Grid& grid = bone.grid();
    for (const VoxelBox& box : changed) {
        const glm::dvec3 low_mm = centre_of_voxel_mm(grid, box.first) - reach * grid.spacing_mm;
        const glm::dvec3 high_mm =
            centre_of_voxel_mm(grid, box.first + box.size - 1) + reach * grid.spacing_mm;
        mark_box(tiles, low_mm, high_mm, to_clip);
    }
    return tiles;
}

IncrementalBonePass::IncrementalBonePass(BoneRenderer& renderer, const glm::ivec2& size_px,
                                         Stopwatch* stopwatch, double frame_s)
    : renderer_(renderer),
      stopwatch_(stopwatch),
      control_(frame_s),
      layer_(size_px),
      coarse_({1, 1}),
      stale_(size_px),
      refined_(size_px) {}

void IncrementalBonePass::resize(const glm::ivec2& size_px) {
    layer_ = gl::Framebuffer(size_px);
    aside_.reset();
    stale_ = TileMask(size_px);
    refined_ = TileMask(size_px);
    camera_.reset();
}

void IncrementalBonePass::set_appearance(const SceneAppearance& look) {
    if (look == renderer_.look()) return;
    renderer_.set_appearance(look);
    forget();
}

void IncrementalBonePass::forget(DrawingCost cost) {
    camera_.reset();
    dirty_.clear();
    if (cost == DrawingCost::as_before) return;
    control_.forget_costs();
    if (measured_) measured_->is_history = true;
}

void IncrementalBonePass::mark_dirty(const BoneTextures& bone, std::span<const VoxelBox> changed) {
    for (const VoxelBox& box : changed) dirty_.push_back(in_whole_blocks(box, bone.box().first));
}

TileMask IncrementalBonePass::update(const BoneTextures& bone, const Camera& camera) {
    learn();
    drawn_this_frame_px_ = 0;
    measures_this_frame_ = false;
    const bool moved = camera_ != camera;
    TileMask fresh(size_px());
    TileMask misplaced(size_px());  // shows a surface where there is none any more
    if (moved) {
        fresh.mark_all();
        misplaced = fresh;
    } else {
        fresh = tiles_of_changes(dirty_, bone, camera, size_px(), shading_reach_voxels);
        misplaced = tiles_of_changes(dirty_, bone, camera, size_px(), surface_reach_voxels);
    }
    frames_of_calm_ = moved || !dirty_.empty() ? 0 : frames_of_calm_ + 1;
    dirty_.clear();
    camera_ = camera;
    frames_at_rest_ = moved ? 0 : frames_at_rest_ + 1;
    if (!stale_.any()) coarsest_divisor_ = 1.0;
    stale_ |= fresh;
    refined_ -= fresh;
    if (!stale_.any()) return stale_;
    const TileMask waiting = TileMask(stale_) -= refined_;

    const Extent extent = moved ? Extent::whole : Extent::parts;
    std::int64_t room_px = frames_of_calm_ >= frames_before_refining ? control_.affordable_pixels_at_rest()
                                                                     : control_.affordable_pixels(extent);
    const bool fits = !stopwatch_ || (moved ? control_.divisor_for(extent, waiting.pixels()) == 1.0
                                            : waiting.pixels() <= room_px);
    if (fits) {
        draw_exact(bone, camera, waiting, extent);
        return show_refined() |= waiting;
    }
    TileMask exact(size_px());
    if (misplaced.any()) {
        const double divisor = control_.divisor_for(extent, misplaced.pixels());
        if (divisor == 1.0)
            exact = misplaced;
        else
            room_px -= draw_coarse(bone, camera, misplaced, extent, divisor);
    }
    draw_exact(bone, camera, exact, extent);
    if (frames_at_rest_ < frames_before_refining) return misplaced;
    // Parts drawn coarsely just now are about to change again and not worth refining.
    TileMask unrefined = TileMask(waiting) -= misplaced;
    const TileMask part = part_that_fits(unrefined, room_px - exact.pixels());
    draw_aside(bone, camera, part, extent);
    unrefined -= part;
    if (unrefined.any()) return misplaced;
    return show_refined() |= misplaced;
}

void IncrementalBonePass::learn() {
    if (!stopwatch_ || !measured_) return;
    const std::optional<double> took_s = stopwatch_->take_s();
    if (!took_s) return;
    if (measured_->is_history) return measured_.reset();
    control_.drew(measured_->extent, measured_->pixels, *took_s);
    if (frame_s_) {
        // Other drawings in that frame cost about as much a pixel.
        const double all_drawing_s = *took_s * static_cast<double>(measured_->pixels_of_frame) /
                                     static_cast<double>(measured_->pixels);
        control_.frame_took(*frame_s_, all_drawing_s);
    }
    measured_.reset();
}

void IncrementalBonePass::frame_took(double frame_s) {
    if (measures_this_frame_) frame_s_ = frame_s;
    if (drawn_this_frame_px_ == 0) control_.frame_took(frame_s, 0.0);
}

void IncrementalBonePass::draw_exact(const BoneTextures& bone, const Camera& camera, const TileMask& tiles,
                                     Extent extent) {
    stale_ -= tiles;
    draw_timed(bone, camera, layer_, tiles.rectangles(), extent);
}

void IncrementalBonePass::draw_aside(const BoneTextures& bone, const Camera& camera, const TileMask& tiles,
                                     Extent extent) {
    if (!tiles.any()) return;
    if (!aside_) aside_.emplace(size_px());
    refined_ |= tiles;
    draw_timed(bone, camera, *aside_, tiles.rectangles(), extent);
}

TileMask IncrementalBonePass::show_refined() {
    const TileMask shown = std::exchange(refined_, TileMask(size_px()));
    for (const PixelBox& box : shown.rectangles()) aside_->copy_to(layer_, box);
    stale_ -= shown;
    return shown;
}

std::int64_t IncrementalBonePass::draw_coarse(const BoneTextures& bone, const Camera& camera,
                                              const TileMask& tiles, Extent extent, double divisor) {
    coarsest_divisor_ = tiles == stale_ ? divisor : std::max(coarsest_divisor_, divisor);
    const glm::ivec2 size = divided(size_px(), divisor);
    if (size != coarse_.size_px()) coarse_ = gl::Framebuffer(size);
    const std::vector<PixelBox> boxes = tiles.rectangles();
    std::vector<PixelBox> coarse_boxes;
    for (const PixelBox& box : boxes) coarse_boxes.push_back(in_coarse(box, size_px(), size));
    const std::int64_t drawn_px = draw_timed(bone, camera, coarse_, coarse_boxes, extent);
    upscaler_.draw(coarse_, layer_, boxes);
    return drawn_px;
}

std::int64_t IncrementalBonePass::draw_timed(const BoneTextures& bone, const Camera& camera,
                                             const gl::Framebuffer& target, std::span<const PixelBox> boxes,
                                             Extent extent) {
    if (boxes.empty()) return 0;
    const bool measures = stopwatch_ && !measured_;
    std::int64_t pixels = 0;
    target.bind();
    if (measures) stopwatch_->start();
    renderer_.draw_parts(bone, camera, target.size_px(), boxes);
    for (const PixelBox& box : boxes) pixels += box.count();
    drawn_this_frame_px_ += pixels;
    if (measures) {
        stopwatch_->stop();
        measured_ = Measured{.extent = extent, .pixels = pixels};
        measures_this_frame_ = true;
        frame_s_.reset();
    }
    if (measures_this_frame_) measured_->pixels_of_frame = drawn_this_frame_px_;
    return pixels;
}

TileMask IncrementalBonePass::part_that_fits(const TileMask& tiles, std::int64_t room_px) {
    TileMask part(size_px());
    std::vector<std::size_t> waiting = tiles.tiles();
    std::rotate(waiting.begin(), std::lower_bound(waiting.begin(), waiting.end(), next_tile_), waiting.end());
    for (const std::size_t tile : waiting) {
        next_tile_ = tile;
        if (room_px <= 0) break;
        part.mark(tiles.box_of_tile(tile));
        room_px -= tiles.box_of_tile(tile).count();
    }
    return part;
}

PictureQuality IncrementalBonePass::quality() const {
    return stale_.any() ? PictureQuality{1.0 / coarsest_divisor_, false} : PictureQuality{};
}

}  // namespace osteomill
