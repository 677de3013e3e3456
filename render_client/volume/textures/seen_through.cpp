#include "render_client/volume/textures/seen_through.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace osteomill {

namespace {

/// Longest edge for which every second voxel has a place: 64 MiB at most.
constexpr int most_seen_places = 320;
constexpr int seen_piece_places = 32;

/// The square of a distance, voxels, and the label that is so far away, in one number: the nearest is the
/// least.
constexpr int square_of_one = 256;
constexpr std::int32_t none_near = (1 << 22) * square_of_one;

/// Fits a cubic to seven places (Savitzky and Golay, Analytical Chemistry 36:1627, 1964): takes off the
/// stairs of a slanted border, and leaves a plane and a curved one where they are.
constexpr std::array<float, 7> smoothing{-2.0f / 21, 3.0f / 21, 6.0f / 21, 7.0f / 21,
                                         6.0f / 21,  3.0f / 21, -2.0f / 21};
constexpr int smoothing_places = 3;

glm::ivec3 divided_up(const glm::ivec3& value, int divisor) {
    return glm::ivec3(glm::ceil(glm::dvec3(value) / static_cast<double>(divisor)));
}

glm::ivec3 divided_down(const glm::ivec3& value, int divisor) {
    return glm::ivec3(glm::floor(glm::dvec3(value) / static_cast<double>(divisor)));
}

VoxelBox box_between(const glm::ivec3& first, const glm::ivec3& end) {
    return {first, glm::max(end - first, 0)};
}

VoxelBox box_round(const VoxelBox& a, const VoxelBox& b) {
    return box_between(glm::min(a.first, b.first), glm::max(a.first + a.size, b.first + b.size));
}

VoxelBox widened(const VoxelBox& box, int by) {
    return {box.first - by, box.size + 2 * by};
}

/// Smooths a block along an axis, which loses smoothing_places at either end; x is fastest.
void smooth_along(int axis, std::vector<float>& values, glm::ivec3& size, std::vector<float>& smoothed) {
    const auto of = [](int edge) { return static_cast<std::size_t>(edge); };
    const std::size_t stride = axis == 0 ? 1 : axis == 1 ? of(size.x) : of(size.x) * of(size.y);
    glm::ivec3 to = size;
    to[axis] -= 2 * smoothing_places;
    smoothed.assign(VoxelBox{{}, to}.count(), 0.0f);
    for (int z = 0; z < to.z; ++z)
        for (int y = 0; y < to.y; ++y) {
            const float* from = &values[(of(z) * of(size.y) + of(y)) * of(size.x)];
            float* row = &smoothed[(of(z) * of(to.y) + of(y)) * of(to.x)];
            for (std::size_t tap = 0; tap < smoothing.size(); ++tap)
                for (std::size_t x = 0; x < of(to.x); ++x) row[x] += smoothing[tap] * from[tap * stride + x];
        }
    size = to;
    values.swap(smoothed);
}

/// Joins boxes that overlap so much that one box round them is hardly larger.
void join_neighbours(std::vector<VoxelBox>& boxes) {
    std::vector<VoxelBox> kept;
    for (const VoxelBox& box : boxes) {
        if (!kept.empty())
            if (const VoxelBox both = box_round(kept.back(), box);
                both.count() <= kept.back().count() + box.count()) {
                kept.back() = both;
                continue;
            }
        kept.push_back(box);
    }
    boxes = std::move(kept);
}

}  // namespace

SeenLattice::SeenLattice(const VoxelBox& of) {
    const int longest = std::max({of.size.x, of.size.y, of.size.z});
    step = std::max(2, (longest + most_seen_places - 1) / most_seen_places);
    box = {of.first - step, of.size + 2 * step};
    places = (box.size - 1) / step + 1;
}

SeenThrough::SeenThrough(const SeenLattice& lattice, double spacing_mm, const SeenTissues& tissues,
                         gl::Texture3D texture)
    : lattice_(lattice), spacing_mm_(spacing_mm), tissues_(tissues), texture_(std::move(texture)) {
    const auto is_seen = [](const SeenTissue& tissue) { return tissue.depth_mm > 0.0f; };
    const auto apart = 255 / std::max<std::ptrdiff_t>(std::ranges::count_if(tissues_, is_seen), 1);
    std::ptrdiff_t number = 0;
    for (std::size_t label = 0; label < tissues_.size(); ++label)
        if (is_seen(tissues_[label])) numbers_[label] = static_cast<std::uint8_t>(number += apart);
    for (const SeenTissue& tissue : tissues_) depth_voxels_ = std::max(depth_voxels_, depth_voxels(tissue));
}

double SeenThrough::depth_voxels(const SeenTissue& tissue) const {
    return std::min(static_cast<double>(tissue.depth_mm) / spacing_mm_,
                    static_cast<double>(most_depth_voxels));
}

int SeenThrough::reach() const {
    return static_cast<int>(std::ceil(depth_voxels_)) + 1;
}

std::vector<VoxelBox> SeenThrough::pieces() const {
    std::vector<VoxelBox> pieces;
    glm::ivec3 first;
    for (first.z = 0; first.z < lattice_.places.z; first.z += seen_piece_places)
        for (first.y = 0; first.y < lattice_.places.y; first.y += seen_piece_places)
            for (first.x = 0; first.x < lattice_.places.x; first.x += seen_piece_places)
                pieces.push_back(box_between(first, glm::min(first + seen_piece_places, lattice_.places)));
    return pieces;
}

void SeenThrough::mark_bricks(const Bone& bone, std::size_t slot) {
    const ByteBrick* labels = bone.content().tissues_of(static_cast<std::int32_t>(slot));
    slot_shows_.push_back(labels != nullptr && std::ranges::any_of(*labels, [&](std::uint8_t label) {
                              return tissues_[label].depth_mm > 0.0f;
                          }));
}

Steps SeenThrough::fill(const Bone& bone) {
    slot_shows_.reserve(bone.stored_bricks());
    for (std::size_t slot = 0; slot < bone.stored_bricks(); ++slot) {
        mark_bricks(bone, slot);
        if (slot % 256 == 0)
            co_yield 0.2 * static_cast<double>(slot) / static_cast<double>(bone.stored_bricks());
    }
    const std::vector<VoxelBox> all = pieces();
    for (std::size_t piece = 0; piece < all.size(); ++piece) {
        compute(bone, all[piece]);
        co_yield 0.2 + 0.8 * static_cast<double>(piece) / static_cast<double>(all.size());
    }
}

std::span<const VoxelBox> SeenThrough::update(const Bone& bone, std::span<const BrickChange> changes) {
    std::vector<VoxelBox> places;
    const BoneContent& content = bone.content();
    for (const BrickChange& change : changes) {
        const std::int32_t slot = bone.slot(change.brick);
        if (slot == BoneContent::no_slot || !slot_shows_[static_cast<std::size_t>(slot)]) continue;
        const glm::ivec3 first = brick_edge_voxels * brick_position(content.size_bricks, change.brick);
        VoxelBox seen;
        change.voxels.for_each([&](std::size_t offset) {
            if (!(tissues_[content.tissue_in(slot, offset)].depth_mm > 0.0f)) return;
            const VoxelBox voxel{first + voxel_in_brick(offset), glm::ivec3(1)};
            seen = seen.count() == 0 ? voxel : box_round(seen, voxel);
        });
        if (const VoxelBox near = places_near(seen); near.count() > 0) places.push_back(near);
    }
    join_neighbours(places);
    changed_.clear();
    for (const VoxelBox& box : places) {
        compute(bone, box);
        changed_.push_back(voxels_of(box));
    }
    return changed_;
}

void SeenThrough::add(std::uint8_t label, StructureMask structure, int coarsening) {
    const std::optional<VoxelBounds> bounds = structure.bounds();
    if (!bounds || !(tissues_[label].depth_mm > 0.0f)) return;
    const VoxelBox near = places_near(
        box_between(divided_down(bounds->first, coarsening), divided_down(bounds->last, coarsening) + 1));
    soft_.push_back({label, std::move(structure), coarsening});
    for (const VoxelBox& piece : pieces()) {
        const VoxelBox both = box_between(glm::max(piece.first, near.first),
                                          glm::min(piece.first + piece.size, near.first + near.size));
        if (both.count() > 0 && std::ranges::find(due_, piece) == due_.end()) due_.push_back(piece);
    }
}

VoxelBox SeenThrough::work(const Bone& bone) {
    if (due_.empty()) return {};
    const VoxelBox places = due_.back();
    due_.pop_back();
    compute(bone, places);
    return voxels_of(places);
}

VoxelBox SeenThrough::places_near(const VoxelBox& voxels) const {
    if (voxels.count() == 0) return {};
    const int far = reach() + smoothing_places * lattice_.step;
    const glm::ivec3 low = voxels.first - lattice_.box.first - far;
    const glm::ivec3 high = voxels.first + voxels.size - 1 - lattice_.box.first + far;
    return box_between(glm::max(divided_up(low, lattice_.step), 0),
                       glm::min(divided_down(high, lattice_.step) + 1, lattice_.places));
}

VoxelBox SeenThrough::voxels_of(const VoxelBox& places) const {
    return {lattice_.box.first + places.first * lattice_.step, places.size * lattice_.step};
}

bool SeenThrough::gather(const Bone& bone, const VoxelBox& voxels) {
    label_of_voxel_.assign(voxels.count(), 0);
    const BoneContent& content = bone.content();
    const glm::ivec3 end = voxels.first + voxels.size;
    const glm::ivec3 first_brick = glm::max(divided_down(voxels.first, brick_edge_voxels), 0);
    const glm::ivec3 end_brick = glm::min(divided_up(end, brick_edge_voxels), content.size_bricks);
    bool has_any = false;
    glm::ivec3 brick;
    for (brick.z = first_brick.z; brick.z < end_brick.z; ++brick.z)
        for (brick.y = first_brick.y; brick.y < end_brick.y; ++brick.y)
            for (brick.x = first_brick.x; brick.x < end_brick.x; ++brick.x) {
                const std::int32_t slot = bone.slot(brick);
                if (slot == BoneContent::no_slot || !slot_shows_[static_cast<std::size_t>(slot)]) continue;
                const ByteBrick& labels = content.tissue[static_cast<std::size_t>(slot)];
                const auto fractions = bone.fractions(slot);
                const glm::ivec3 origin = brick * brick_edge_voxels;
                const glm::ivec3 low = glm::max(voxels.first, origin);
                const glm::ivec3 high = glm::min(end, origin + brick_edge_voxels);
                for (int z = low.z; z < high.z; ++z)
                    for (int y = low.y; y < high.y; ++y) {
                        std::size_t from = offset_in_brick(glm::ivec3(low.x, y, z) - origin);
                        const glm::ivec3 to = glm::ivec3(low.x, y, z) - voxels.first;
                        std::uint8_t* label =
                            &label_of_voxel_[(static_cast<std::size_t>(to.z) * voxels.size.y + to.y) *
                                                 voxels.size.x +
                                             to.x];
                        for (int x = low.x; x < high.x; ++x, ++from, ++label)
                            if (fractions[from] >= 128 && tissues_[labels[from]].depth_mm > 0.0f) {
                                *label = labels[from];
                                has_any = true;
                            }
                    }
            }
    for (const Soft& soft : soft_) has_any = gather_soft(soft, voxels) || has_any;
    return has_any;
}

bool SeenThrough::gather_soft(const Soft& soft, const VoxelBox& voxels) {
    bool has_any = false;
    const glm::ivec3 size_bricks = size_in_bricks(soft.mask.grid());
    const glm::ivec3 low = voxels.first * soft.coarsening;
    const glm::ivec3 high = (voxels.first + voxels.size) * soft.coarsening;
    for (const StructureBrick& brick : soft.mask.bricks()) {
        const glm::ivec3 first = brick_edge_voxels * brick_position(size_bricks, brick.brick);
        if (glm::any(glm::greaterThanEqual(first, high)) ||
            glm::any(glm::lessThanEqual(first + brick_edge_voxels, low)))
            continue;
        brick.voxels.for_each([&](std::size_t offset) {
            const glm::ivec3 at =
                divided_down(first + voxel_in_brick(offset), soft.coarsening) - voxels.first;
            if (glm::any(glm::lessThan(at, glm::ivec3(0))) ||
                glm::any(glm::greaterThanEqual(at, voxels.size)))
                return;
            label_of_voxel_[(static_cast<std::size_t>(at.z) * voxels.size.y + at.y) * voxels.size.x + at.x] =
                soft.label;
            has_any = true;
        });
    }
    return has_any;
}

void SeenThrough::find_nearest(const VoxelBox& places, const VoxelBox& voxels, int window, bool of_tissue) {
    const int margin = reach();
    const int step = lattice_.step;
    const glm::ivec3 size = places.size, full = voxels.size;
    const auto nx = static_cast<std::size_t>(size.x);
    const auto is_found = [&](std::uint8_t label) { return (label != 0) == of_tissue; };
    const auto near = [](int away, std::uint8_t label) { return away * away * square_of_one + label; };
    // Along x, row by row of the voxels: the nearest to the left, then to the right.
    nearest_[0].assign(nx * static_cast<std::size_t>(full.y) * static_cast<std::size_t>(full.z), none_near);
    for (std::size_t row = 0; row < static_cast<std::size_t>(full.y) * static_cast<std::size_t>(full.z);
         ++row) {
        const std::uint8_t* label = &label_of_voxel_[row * static_cast<std::size_t>(full.x)];
        std::int32_t* nearest = &nearest_[0][row * nx];
        const int nowhere = -full.x;
        int found = nowhere;
        for (int place = 0, x = 0; place < size.x; ++place) {
            const int here = margin + place * step;
            for (; x <= here; ++x) found = is_found(label[x]) ? x : found;
            if (here - found <= window) nearest[place] = near(here - found, label[found]);
        }
        found = 2 * full.x;
        for (int place = size.x - 1, x = full.x - 1; place >= 0; --place) {
            const int here = margin + place * step;
            for (; x >= here; --x) found = is_found(label[x]) ? x : found;
            if (found - here <= window)
                nearest[place] = std::min(nearest[place], near(found - here, label[found]));
        }
    }
    // Then across the rows, for whole rows at once, by window.
    const auto across = [&](std::size_t from, int rows_before, int rows, int planes, std::size_t row) {
        nearest_[from + 1].assign(row * static_cast<std::size_t>(rows) * static_cast<std::size_t>(planes),
                                  none_near);
        for (int plane = 0; plane < planes; ++plane)
            for (int to = 0; to < rows; ++to) {
                const int at = margin + to * step;
                std::int32_t* least = &nearest_[from + 1][static_cast<std::size_t>(plane * rows + to) * row];
                for (int source = std::max(at - window, 0); source <= std::min(at + window, rows_before - 1);
                     ++source) {
                    const std::int32_t* of =
                        &nearest_[from][static_cast<std::size_t>(plane * rows_before + source) * row];
                    const std::int32_t more = near(source - at, 0);
                    for (std::size_t x = 0; x < row; ++x) least[x] = std::min(least[x], of[x] + more);
                }
            }
    };
    across(0, full.y, size.y, full.z, nx);
    across(1, full.z, size.z, 1, nx * static_cast<std::size_t>(size.y));
}

void SeenThrough::compute(const Bone& bone, const VoxelBox& places) {
    const int far = reach();
    const VoxelBox wide = widened(places, smoothing_places);
    const VoxelBox voxels{lattice_.box.first + wide.first * lattice_.step - far,
                          (wide.size - 1) * lattice_.step + 1 + 2 * far};
    texels_.assign(2 * places.count(), 0);
    if (gather(bone, voxels)) {
        find_distances(wide, voxels);
        glm::ivec3 size = wide.size;
        for (int axis = 0; axis < 3; ++axis) smooth_along(axis, distances_, size, smoothed_);
        for (std::size_t place = 0; place < distances_.size(); ++place) {
            const double part = (farthest_voxels() - static_cast<double>(distances_[place])) / span_voxels();
            texels_[2 * place] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(part, 0.0, 1.0)));
        }
        std::size_t to = 1;
        for (int z = 0; z < places.size.z; ++z)
            for (int y = 0; y < places.size.y; ++y) {
                const glm::ivec3 first = glm::ivec3(0, y, z) + smoothing_places;
                std::size_t from =
                    (static_cast<std::size_t>(first.z) * wide.size.y + first.y) * wide.size.x + first.x;
                for (int x = 0; x < places.size.x; ++x, ++from, to += 2)
                    texels_[to] = numbers_[labels_[from]];
            }
    }
    texture_.upload(places.first, places.size, texels_);
}

void SeenThrough::find_distances(const VoxelBox& places, const VoxelBox& voxels) {
    const auto distance = [](std::int32_t nearest, int most) {
        return std::sqrt(static_cast<float>(std::min(nearest / square_of_one, most * most)));
    };
    find_nearest(places, voxels, reach(), true);
    distances_.resize(places.count());
    labels_.resize(places.count());
    bool is_within = false;
    for (std::size_t place = 0; place < distances_.size(); ++place) {
        const std::int32_t nearest = nearest_[2][place];
        is_within = is_within || nearest < square_of_one;
        distances_[place] = distance(nearest, reach()) - 0.5f;
        labels_[place] = static_cast<std::uint8_t>(nearest % square_of_one);
    }
    if (!is_within) return;
    // As deep as the smoothing of a place at the border looks.
    const int deep = smoothing_places * lattice_.step + 1;
    find_nearest(places, voxels, deep, false);
    for (std::size_t place = 0; place < distances_.size(); ++place)
        if (const std::int32_t nearest = nearest_[2][place]; nearest >= square_of_one)
            distances_[place] = 0.5f - distance(nearest, deep);
}

}  // namespace osteomill
