#include "render_client/dataset/surface_labels.h"

#include <cmath>

#include "common/bone/bone_ray.h"
#include "studies/render/made_bone.h"
#include "tests/unit/volume/offscreen_test.h"

namespace osteomill::surface_labels_test {
namespace {

class SurfaceLabelsTest : public OffscreenTest {};

const glm::ivec2 size_px(320, 240);
const Grid grid{.size_voxels = {96, 96, 96}, .spacing_mm = 0.1, .origin_mm = {-4.75, -4.75, -4.75}};
const std::vector<Tissue> tissues{{.label = 7, .name = "above", .colour_rgb = {1, 2, 3}},
                                  {.label = 9, .name = "below", .colour_rgb = {4, 5, 6}},
                                  {.label = 12, .name = "nerve", .colour_rgb = {7, 8, 9}}};
constexpr double radius_mm = 3.3;

std::uint8_t tissue_at(const glm::dvec3& p) {
    if (glm::length(glm::dvec2(p.x + p.y, p.z)) < 0.8) return 12;
    return glm::dot(glm::dvec3(0.3, 0.2, 0.9), p) > 0.4 ? 7 : 9;
}

/// Pixels of a label that both have, over those that either has.
double overlap(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b, std::uint8_t label) {
    int both = 0, either = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        both += a[i] == label && b[i] == label;
        either += a[i] == label || b[i] == label;
    }
    return either > 0 ? static_cast<double>(both) / either : 0.0;
}

template <typename LabelOf>
std::vector<std::uint8_t> cast(const Camera& camera, LabelOf label_of) {
    std::vector<std::uint8_t> labels;
    for (int y = 0; y < size_px.y; ++y)
        for (int x = 0; x < size_px.x; ++x)
            labels.push_back(
                label_of(camera.eye_mm(), direction_through(camera, {x + 0.5, y + 0.5}, size_px)));
    return labels;
}

TEST_F(SurfaceLabelsTest, AreThoseOfABallInClosedFormAndOfRaysInDoublePrecision) {
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return radius_mm - glm::length(p); }, tissue_at);
    std::vector<TissueColour> colours;
    for (const Tissue& tissue : tissues) colours.push_back({tissue.label, tissue.colour_rgb});
    const BoneTextures textures(bone, colours);
    const Camera camera = camera_on(glm::dvec3(0.0), 4.0);
    const SurfaceImage image = SurfacePass(size_px).draw(textures, nullptr, camera);
    const std::vector<std::uint8_t> labels = surface_labels(image, camera, bone, tissues);

    const auto label_of_number = [](std::uint8_t number) {
        return label_of_tissue(number == 7 ? 0 : number == 9 ? 1 : 2);
    };
    const auto of_ball = cast(camera, [&](const glm::dvec3& eye, const glm::dvec3& direction) {
        const double b = glm::dot(eye, direction), c = glm::dot(eye, eye) - radius_mm * radius_mm;
        if (b * b < c) return SurfaceImage::nothing;
        return label_of_number(tissue_at(eye + (-b - std::sqrt(b * b - c)) * direction));
    });
    BoneSampler sampler(bone);
    const auto of_rays = cast(camera, [&](const glm::dvec3& eye, const glm::dvec3& direction) {
        const BoneRay ray{to_voxel_coordinates(grid, eye), direction};
        RaySpan span = span_within(ray, grid);
        span.from = std::max(span.from, 0.0);
        const auto met = sampler.first_surface(ray, span, [](double) { return true; });
        if (!met) return SurfaceImage::nothing;
        return label_of_number(tissue_of_surface(bone, grid.origin_mm + grid.spacing_mm * ray.at(*met)));
    });
    for (std::size_t tissue = 0; tissue < tissues.size(); ++tissue) {
        SCOPED_TRACE(tissues[tissue].name);
        const double of_form = overlap(labels, of_ball, label_of_tissue(tissue));
        const double of_cast = overlap(labels, of_rays, label_of_tissue(tissue));
        EXPECT_GT(of_form, 0.95);
        EXPECT_GT(of_cast, 0.99);
        RecordProperty("iou_" + tissues[tissue].name, std::to_string(of_cast));
    }
}

// A lining of one voxel is seen as one: voxels in front of the surface, less than half full, do not count.
TEST(TissueOfSurface, IsThatOfTheBoneWithinTheSurface) {
    const Bone bone = made_bone(
        grid, [](const glm::dvec3& p) { return -p.z; },
        [](const glm::dvec3& p) { return static_cast<std::uint8_t>(p.z > -0.1 && p.z < 0.0 ? 5 : 3); });
    for (double x = -2.0; x < 2.0; x += 0.037) EXPECT_EQ(tissue_of_surface(bone, {x, 0.3 * x, 0.0}), 5) << x;
    EXPECT_EQ(tissue_of_surface(bone, {0.0, 0.0, -1.0}), 3);
    EXPECT_EQ(tissue_of_surface(bone, {0.0, 0.0, 2.0}), 0);
    std::array<bool, 256> hidden{};
    hidden[5] = true;
    EXPECT_EQ(tissue_of_surface(bone, {0.0, 0.0, -0.06}, hidden), 3);
}

TEST(LabelTable, HasThingsFirstAndThenTissuesInTheirOrder) {
    const std::vector<SurfaceLabel> table = label_table(tissues);
    ASSERT_EQ(table.size(), 7u);
    EXPECT_EQ(table[SurfaceImage::burr].name, "burr");
    EXPECT_EQ(table[label_of_tissue(2)].name, "nerve");
    EXPECT_EQ(table[label_of_tissue(2)].colour_rgb, (std::array<std::uint8_t, 3>{7, 8, 9}));
    const std::vector<Tissue> many(300);
    EXPECT_EQ(label_table(many).size(), 256u);
    EXPECT_EQ(label_of_tissue(251), 255);
    EXPECT_EQ(label_of_tissue(252), SurfaceImage::bone);
}

}  // namespace
}  // namespace osteomill::surface_labels_test
