#include "imaging/picture/bone_picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "common/bone/bone_ray.h"
#include "imaging/formats/source_image.h"
#include "imaging/picture/smooth_border.h"

namespace osteomill {

namespace {

/// A pixel whose colour differs visibly from a neighbour's takes several rays, any other one: adaptive
/// antialiasing after Whitted (1980), in a third of the time of several rays everywhere.
constexpr int rays_per_edge_pixel_side = 3;
constexpr double edge_step = 10.0;  // of 255
const glm::dvec3 bone_colour(226.0, 216.0, 198.0);

/// More voxels about a section are drawn as they are: with 20 bytes for each, several pictures at a time.
constexpr std::size_t most_smoothed_voxels = 4'000'000;

/// The voxels that a section passes through; nothing if there are too many for smooth borders.
std::optional<VoxelBounds> voxels_of_section(const Grid& grid, const BoneView& view) {
    const glm::dvec3 right = glm::cross(view.direction, view.up);
    const glm::dvec3 extent_mm = view.half_width_mm * (glm::abs(right) + glm::abs(view.up));
    const VoxelBounds box{glm::ivec3(glm::floor(to_voxel_coordinates(grid, view.centre_mm - extent_mm))),
                          glm::ivec3(glm::ceil(to_voxel_coordinates(grid, view.centre_mm + extent_mm)))};
    const VoxelBounds within{glm::max(box.first, -1), glm::min(box.last, grid.size_voxels)};
    const glm::dvec3 size = glm::dvec3(within.last - within.first + 1 + 2 * SmoothBorder::reach_voxels);
    const bool is_beside = glm::any(glm::greaterThan(within.first, within.last));
    if (is_beside || size.x * size.y * size.z > static_cast<double>(most_smoothed_voxels))
        return std::nullopt;
    return within;
}

VoxelBounds grown(const VoxelBounds& box, int by) {
    return {box.first - by, box.last + by};
}

bool meet(const VoxelBounds& a, const VoxelBounds& b) {
    return glm::all(glm::lessThanEqual(a.first, b.last)) && glm::all(glm::lessThanEqual(b.first, a.last));
}

/// The tissues of a section's bone.
class TissueBorders {
  public:
    TissueBorders(const Bone& bone, const VoxelBounds& box) {
        const VoxelBounds about = grown(box, SmoothBorder::reach_voxels);
        const glm::ivec3 size = about.last - about.first + 1;
        std::vector<std::int16_t> labels;
        std::array<bool, 256> is_there{};
        for (int z = 0; z < size.z; ++z)
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) {
                    const glm::ivec3 voxel = about.first + glm::ivec3(x, y, z);
                    const bool is_bone = contains(bone.grid(), voxel) && bone.fraction_at(voxel) > 0;
                    labels.push_back(is_bone ? std::int16_t{bone.tissue_at(voxel)} : no_bone);
                    if (is_bone) is_there[bone.tissue_at(voxel)] = true;
                }
        const auto of_label = [&](std::size_t label) {
            return [&, label](const glm::ivec3& voxel) {
                return labels[voxel_index(voxel - about.first, size)] == static_cast<std::int16_t>(label);
            };
        };
        // One tissue alone has no border.
        if (std::ranges::count(is_there, true) < 2) return;
        for (std::size_t label = 0; label < is_there.size(); ++label)
            if (is_there[label]) borders_.emplace_back(label, SmoothBorder(box, of_label(label)));
    }

    /// The label of the bone at a place, as its nearest border says; nothing where there is one tissue at
    /// most.
    std::optional<std::size_t> label_at(const glm::dvec3& place) const {
        std::optional<std::size_t> nearest;
        double least = 0.0;
        for (const auto& [label, border] : borders_)
            if (const double distance = border.distance(place); !nearest || distance < least)
                nearest = label, least = distance;
        return nearest;
    }

  private:
    static constexpr std::int16_t no_bone = -1;
    std::vector<std::pair<std::size_t, SmoothBorder>> borders_;
};

class View {
  public:
    View(const Bone& bone, std::span<const Tissue> tissues, const BoneView& view, const SectionMarks& marks)
        : bone_(bone), tissues_(tissues), view_(view), marks_(marks), probe_(bone) {
        if (view.is_section)
            if (const auto box = voxels_of_section(bone.grid(), view)) find_borders(*box);
        colours_.fill(bone_colour);
        for (const Tissue& tissue : tissues)
            colours_[tissue.label] =
                glm::dvec3(tissue.colour_rgb[0], tissue.colour_rgb[1], tissue.colour_rgb[2]);
        light_ = glm::normalize(-view.direction + 0.6 * view.up - 0.5 * right());
    }

    glm::dvec3 right() const { return glm::cross(view_.direction, view_.up); }

    /// `background`: where no bone is.
    glm::dvec3 colour(const glm::dvec3& place_mm, const glm::dvec3& background) {
        const BoneRay ray{to_voxel_coordinates(bone_.grid(), place_mm), view_.direction};
        if (view_.is_section)
            if (const auto structure = structure_colour(ray.origin)) return *structure;
        RaySpan span = span_within(ray, bone_.grid());
        if (view_.is_section) span.from = std::max(span.from, 0.0);
        if (span.is_empty()) return background;
        const glm::dvec3 first = ray.at(span.from + 1e-6);
        if (view_.is_section && span.from == 0.0 && probe_.between(first) > surface_fraction)
            return 0.92 * colour_of_cut(first);
        const auto hit = probe_.first_surface(ray, span, [](double) { return true; });
        return hit ? lit(ray, *hit) : background;
    }

  private:
    glm::dvec3 lit(const BoneRay& ray, double t) {
        const glm::dvec3 place = ray.at(t);
        const glm::dvec3 gradient = smoothed_gradient(place);
        const double length = glm::length(gradient);
        const glm::dvec3 normal = length > 0.0 ? -gradient / length : -view_.direction;
        const double diffuse = std::max(0.0, glm::dot(normal, light_));
        return (0.28 + 0.72 * diffuse) * tissue_colour(place + 0.6 * view_.direction);
    }

    /// The window's gradient, which shows no rings where a surface crosses the voxels' layers: 4^3 trilinear
    /// samples a voxel apart (gradient_by_samples in bone_sampling.glsl), here as weights of the 5^3 voxels
    /// about them.
    glm::dvec3 smoothed_gradient(const glm::dvec3& place) {
        const glm::dvec3 first = glm::floor(place - 1.5);
        const glm::dvec3 part = place - 1.5 - first;
        using Weights = std::array<glm::dvec3, 5>;
        const auto spread = [&](const std::array<double, 4>& samples) {
            Weights weights{};
            for (std::size_t i = 0; i < samples.size(); ++i) {
                weights[i] += samples[i] * (1.0 - part);
                weights[i + 1] += samples[i] * part;
            }
            return weights;
        };
        const Weights along = spread({-1.5, -1.0, 1.0, 1.5});
        const Weights across = spread({1.0, 3.5, 3.5, 1.0});
        glm::dvec3 gradient(0.0);
        for (std::size_t z = 0; z < 5; ++z)
            for (std::size_t y = 0; y < 5; ++y)
                for (std::size_t x = 0; x < 5; ++x)
                    gradient += probe_.at(glm::ivec3(first) + glm::ivec3(x, y, z)) *
                                glm::dvec3(along[x].x * across[y].y * across[z].z,
                                           across[x].x * along[y].y * across[z].z,
                                           across[x].x * across[y].y * along[z].z);
        return gradient;
    }

    void find_borders(const VoxelBounds& box) {
        tissue_borders_.emplace(bone_, box);
        for (const Structure& structure : marks_.structures) {
            const auto bounds = structure.mask.bounds();
            if (!bounds || !meet(grown(box, SmoothBorder::reach_voxels), *bounds)) continue;
            structure_borders_.emplace_back(&structure, SmoothBorder(box, [&](const glm::ivec3& voxel) {
                return structure.mask.contains(voxel);
            }));
        }
    }

    /// A structure's place that never was bone. One of a structure that is bone is drawn where bone is left:
    /// milled, it is a cavity, and its surface is where bone ends, between voxels.
    bool lacks_bone(const Structure& structure, const glm::dvec3& place) {
        bool has_soft = false;
        for_voxels_about(place, [&](const glm::ivec3& voxel, double) {
            has_soft = has_soft || (is_soft(structure, voxel) && structure.mask.contains(voxel));
        });
        return has_soft;
    }

    bool is_soft(const Structure& structure, const glm::ivec3& voxel) {
        return !contains(bone_.grid(), voxel) ||
               (probe_.at(voxel) == 0.0 && bone_.tissue_at(voxel) != tissues_[structure.tissue].label);
    }

    std::optional<glm::dvec3> structure_colour(const glm::dvec3& place) {
        if (tissue_borders_) {
            for (const auto& [structure, border] : structure_borders_)
                if (border.holds(place) &&
                    (probe_.between(place) > surface_fraction || lacks_bone(*structure, place)))
                    return colours_[tissues_[structure->tissue].label];
            return std::nullopt;
        }
        for (const Structure& structure : marks_.structures)
            if (is_mostly(place, [&](const glm::ivec3& voxel) {
                    return structure.mask.contains(voxel) &&
                           (is_soft(structure, voxel) || probe_.at(voxel) > 0.0);
                }))
                return colours_[tissues_[structure.tissue].label];
        return std::nullopt;
    }

    glm::dvec3 colour_of_cut(const glm::dvec3& place) {
        if (tissue_borders_)
            if (const auto label = tissue_borders_->label_at(place)) return colours_[*label];
        return tissue_colour(place);
    }

    /// Tissues weighted by a cubic B-spline of the 4^3 voxels about a place, the heavier ones more, so that
    /// their border has no steps and stays narrow. A voxel that was milled away still has its tissue: left
    /// out, a border on a milled wall would follow the wall's voxels.
    glm::dvec3 tissue_colour(const glm::dvec3& place) {
        const glm::dvec3 low = glm::floor(place);
        const std::array<glm::dvec3, 4> along = spline_weights(place - low);
        std::array<TissueWeight, 64> found;
        std::size_t count = 0;
        for (std::size_t z = 0; z < 4; ++z)
            for (std::size_t y = 0; y < 4; ++y)
                for (std::size_t x = 0; x < 4; ++x) {
                    const glm::ivec3 voxel = glm::ivec3(low) + glm::ivec3(x, y, z) - 1;
                    if (!contains(bone_.grid(), voxel)) continue;
                    const std::uint8_t label = bone_.tissue_at(voxel);
                    if (label == 0 && probe_.at(voxel) == 0.0) continue;
                    const auto end = found.begin() + static_cast<std::ptrdiff_t>(count);
                    const auto known = std::find_if(
                        found.begin(), end, [&](const TissueWeight& one) { return one.label == label; });
                    if (known == end) found[count++] = {.label = label, .weight = 0.0};
                    known->weight += along[x].x * along[y].y * along[z].z;
                }
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            const double weight = std::pow(found[i].weight, 4.0);
            sum += weight * colours_[found[i].label];
            weights += weight;
        }
        return weights > 0.0 ? sum / weights : bone_colour;
    }

    struct TissueWeight {
        std::uint8_t label = 0;
        double weight = 0.0;
    };

    /// Weights of the places -1, 0, 1 and 2 at a part of the way from 0 to 1; along each axis they add up to
    /// one.
    static std::array<glm::dvec3, 4> spline_weights(const glm::dvec3& part) {
        const glm::dvec3 rest = 1.0 - part;
        return {rest * rest * rest / 6.0, 2.0 / 3.0 - part * part * (1.0 - part / 2.0),
                2.0 / 3.0 - rest * rest * (1.0 - rest / 2.0), part * part * part / 6.0};
    }

    const Bone& bone_;
    std::span<const Tissue> tissues_;
    const BoneView& view_;
    const SectionMarks& marks_;
    BoneSampler probe_;
    std::optional<TissueBorders> tissue_borders_;  // of a section; nothing: drawn voxel by voxel
    std::vector<std::pair<const Structure*, SmoothBorder>> structure_borders_;
    std::array<glm::dvec3, 256> colours_;
    glm::dvec3 light_{0.0};
};

/// From the picture's left to its right, or from its bottom to its top.
double offset_mm(const BoneView& view, double pixel, int size_px) {
    return view.half_width_mm * (2.0 * pixel / size_px - 1.0);
}

/// A colour a pixel, 0 to 255.
class Colours {
  public:
    explicit Colours(int size_px)
        : size_px_(size_px),
          colours_(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px)) {}

    glm::dvec3& at(int row, int column) { return colours_[place(row, column)]; }

    bool is_at_an_edge(int row, int column) const {
        const glm::dvec3& here = colours_[place(row, column)];
        for (int y = std::max(row - 1, 0); y <= std::min(row + 1, size_px_ - 1); ++y)
            for (int x = std::max(column - 1, 0); x <= std::min(column + 1, size_px_ - 1); ++x)
                if (glm::any(glm::greaterThan(glm::abs(colours_[place(y, x)] - here), glm::dvec3(edge_step))))
                    return true;
        return false;
    }

  private:
    std::size_t place(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(size_px_) +
               static_cast<std::size_t>(column);
    }

    int size_px_;
    std::vector<glm::dvec3> colours_;
};

/// Colours the pixels of the region that have a neighbour outside of it.
void draw_outline(RgbPicture& picture, const BoneView& view, const glm::dvec3& right,
                  const std::function<bool(const glm::dvec3& place_mm)>& is_outlined) {
    constexpr std::array<std::uint8_t, 3> colour{0, 90, 200};
    const int size = picture.size_px;
    std::vector<char> is_in;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            is_in.push_back(is_outlined(view.centre_mm + offset_mm(view, column + 0.5, size) * right -
                                        offset_mm(view, row + 0.5, size) * view.up));
    const auto at = [&](int row, int column) {
        return is_in[static_cast<std::size_t>(std::clamp(row, 0, size - 1) * size +
                                              std::clamp(column, 0, size - 1))];
    };
    const int reach = std::max(1, size / 320);
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column)
            if (at(row, column) && !(at(row - reach, column) && at(row + reach, column) &&
                                     at(row, column - reach) && at(row, column + reach)))
                std::ranges::copy(colour, picture.rgb.begin() + 3 * (row * size + column));
}

/// A region of voxels as a rule for places.
std::function<bool(const glm::dvec3& place_mm)> outlined(const Grid& grid, const BoneView& view,
                                                         const SectionMarks& marks) {
    if (!marks.is_outlined_voxel) return marks.is_outlined;
    if (const auto box = voxels_of_section(grid, view))
        return [&grid, border = SmoothBorder(*box, marks.is_outlined_voxel)](const glm::dvec3& place_mm) {
            return border.holds(to_voxel_coordinates(grid, place_mm));
        };
    return [&](const glm::dvec3& place_mm) {
        return is_mostly(to_voxel_coordinates(grid, place_mm), marks.is_outlined_voxel);
    };
}

}  // namespace

RgbPicture picture_of(const Bone& bone, std::span<const Tissue> tissues, const BoneView& view, int size_px,
                      const SectionMarks& marks) {
    View seen(bone, tissues, view, marks);
    const glm::dvec3 right = seen.right();
    /// The mean of rays^2 rays of a pixel.
    const auto colour = [&](int row, int column, int rays) {
        const glm::dvec3 background = glm::mix(view.background[0], view.background[1], (row + 0.5) / size_px);
        const auto offset = [&](int pixel, int ray) {
            return offset_mm(view, pixel + (ray + 0.5) / rays, size_px);
        };
        glm::dvec3 sum(0.0);
        for (int j = 0; j < rays; ++j)
            for (int i = 0; i < rays; ++i)
                sum += seen.colour(view.centre_mm + offset(column, i) * right - offset(row, j) * view.up,
                                   background);
        return sum / static_cast<double>(rays * rays);
    };
    Colours once(size_px);
    for (int row = 0; row < size_px; ++row)
        for (int column = 0; column < size_px; ++column) once.at(row, column) = colour(row, column, 1);
    RgbPicture picture{.size_px = size_px, .rgb = {}};
    picture.rgb.reserve(static_cast<std::size_t>(size_px) * static_cast<std::size_t>(size_px) * 3);
    for (int row = 0; row < size_px; ++row) {
        for (int column = 0; column < size_px; ++column) {
            const glm::dvec3 drawn = once.is_at_an_edge(row, column)
                                         ? colour(row, column, rays_per_edge_pixel_side)
                                         : once.at(row, column);
            for (int channel = 0; channel < 3; ++channel)
                picture.rgb.push_back(
                    static_cast<std::uint8_t>(std::lround(std::clamp(drawn[channel], 0.0, 255.0))));
        }
    }
    if (view.is_section && (marks.is_outlined || marks.is_outlined_voxel))
        draw_outline(picture, view, right, outlined(bone.grid(), view, marks));
    return picture;
}

std::string lasting_png(std::span<const std::uint8_t> rgb, const glm::ivec2& size_px) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.format = PNG_FORMAT_RGB;
    image.width = static_cast<png_uint_32>(size_px.x);
    image.height = static_cast<png_uint_32>(size_px.y);
    std::string png;
    png_alloc_size_t bytes = PNG_IMAGE_PNG_SIZE_MAX(image);
    png.resize(bytes);
    if (!png_image_write_to_memory(&image, png.data(), &bytes, 0, rgb.data(), 0, nullptr))
        throw std::runtime_error(fmt::format("a picture cannot be made: {}", image.message));
    png.resize(bytes);
    return png;
}

void write_lasting_png(std::span<const std::uint8_t> rgb, const glm::ivec2& size_px,
                       const std::filesystem::path& path, Link link) {
    write_atomic_file(path, lasting_png(rgb, size_px), link);
}

}  // namespace osteomill
