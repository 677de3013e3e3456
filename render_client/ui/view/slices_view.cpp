#include "render_client/ui/view/slices_view.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

namespace osteomill {

namespace {

constexpr double narrowest_mm = 4.0;
constexpr double widest_mm = 500.0;

glm::dvec3 last_mm(const CtVolume& ct) {
    return centre_of_voxel_mm(ct.grid, ct.grid.size_voxels - 1);
}

}  // namespace

void SlicesView::set_ct(std::shared_ptr<const CtVolume> ct) {
    ct_ = std::move(ct);
    if (!ct_) return;
    const glm::dvec3 low_mm = ct_->grid.origin_mm;
    const glm::dvec3 high_mm = last_mm(*ct_);
    width_mm_ =
        std::min(widest_mm, std::max({high_mm.x - low_mm.x, high_mm.y - low_mm.y, high_mm.z - low_mm.z}));
    centre_mm_ = 0.5 * (low_mm + high_mm);
    cross_at(cross_mm_.value_or(0.5 * (low_mm + high_mm)));
}

void SlicesView::set_tissues(std::span<const Tissue> tissues) {
    tissues_.clear();
    for (const Tissue& tissue : tissues)
        tissues_.push_back({.label = tissue.label, .colour_rgb = tissue.colour_rgb, .mask = {}});
    for (auto& drawn : drawn_) drawn.reset();
}

void SlicesView::set_mask(std::size_t tissue, const StructureMask& mask) {
    if (tissue < tissues_.size()) tissues_[tissue].mask = mask;
    for (auto& drawn : drawn_) drawn.reset();
}

void SlicesView::cross_at(const glm::dvec3& position_mm) {
    cross_mm_ = ct_ ? glm::clamp(position_mm, ct_->grid.origin_mm, last_mm(*ct_)) : position_mm;
}

void SlicesView::zoom(double factor) {
    width_mm_ = std::clamp(factor * width_mm_, narrowest_mm, widest_mm);
    centre_mm_ = cross_mm_.value_or(centre_mm_);
}

SliceView SlicesView::view(SlicePlane plane, int edge_px) const {
    SliceView view{.plane = plane,
                   .centre_mm = centre_mm_,
                   .mm_per_px = width_mm_ / std::max(edge_px, 1),
                   .edge_px = edge_px};
    if (cross_mm_) view.centre_mm += glm::dot(*cross_mm_ - centre_mm_, view.across()) * view.across();
    return view;
}

const gl::Texture2D& SlicesView::picture(SlicePlane plane, int edge_px, const Bone* bone,
                                         std::uint64_t bone_version) {
    std::optional<DrawnSlice>& drawn = drawn_[static_cast<std::size_t>(plane)];
    const SliceView wanted = view(plane, edge_px);
    const bool is_fresh = drawn && drawn->view == wanted && drawn->window == window_ &&
                          drawn->ct == ct_.get() && drawn->bone_version == bone_version;
    if (!is_fresh) {
        if (!drawn) drawn.emplace();
        drawn->texture.upload({edge_px, edge_px}, slice_picture(*ct_, bone, tissues_, wanted, window_));
        drawn->view = wanted;
        drawn->window = window_;
        drawn->ct = ct_.get();
        drawn->bone_version = bone_version;
    }
    return drawn->texture;
}

}  // namespace osteomill
