#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "analysis/report/motion_metrics.h"
#include "analysis/report/session_trace.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_session.h"

namespace osteomill {
namespace {

constexpr double well_spacing_mm = 0.2;
constexpr double top_mm = 3.2;
const glm::dvec3 in_well_mm(0.0, 0.0, 0.5);  // 2.7 below the top

bool is_in_well(const glm::dvec3& place) {
    return std::abs(place.x) < 1.0 && std::abs(place.y) < 1.0 && place.z > -0.5;
}

/// From 100 mm off, `from_above_deg` from straight above towards +x; the picture's middle is turned by
/// `aside_deg` from the burr, about the axis that is right in it, or down.
Viewpoint view_of_well(double from_above_deg, double aside_deg = 0.0, bool is_right = false) {
    const double angle = glm::radians(from_above_deg);
    const glm::dvec3 up_to_eye(std::sin(angle), 0.0, std::cos(angle));
    const glm::dvec3 right(0.0, 1.0, 0.0);
    const glm::dvec3 forward = -up_to_eye;
    const glm::dmat3 axes(right, glm::cross(forward, right), forward);
    const glm::dvec3 about = is_right ? axes[1] : axes[0];
    return {.eye_mm = in_well_mm + 100.0 * up_to_eye,
            .rotation = glm::angleAxis(glm::radians(aside_deg), about) * glm::quat_cast(axes),
            .field_of_view_rad = glm::radians(30.0)};
}

class Well : public ::testing::Test {
  protected:
    Well()
        : bone_(testing::labelled_cube(2, well_spacing_mm,
                                       [](const glm::dvec3&) { return std::uint8_t{1}; })) {}
    /// The bone with the well in it.
    Bone milled() const {
        Bone bone = bone_;
        const BoneContent& content = bone.content();
        for (std::int32_t slot = 0; slot < static_cast<std::int32_t>(bone.stored_bricks()); ++slot) {
            const glm::ivec3 first =
                brick_edge_voxels *
                brick_position(content.size_bricks, content.brick_of_slot[static_cast<std::size_t>(slot)]);
            for (std::size_t offset = 0; offset < brick_voxel_count; ++offset)
                if (is_in_well(centre_of_voxel_mm(bone.grid(), first + voxel_in_brick(offset))))
                    bone.fractions(slot)[offset] = 0;
        }
        return bone;
    }

    Bone bone_;
    std::vector<Tissue> tissues_{{.label = 1, .name = "bone"}};
};

TEST_F(Well, ShowsTheBurrToWhoLooksOverItsRim) {
    // The rim is 1 mm beside the burr and 2.7 mm above it: an eye sees it up to atan(1 / 2.7) = 20.3 degrees.
    const Bone bone = milled();
    EXPECT_TRUE(is_burr_in_view(bone, tissues_, view_of_well(0.0), in_well_mm));
    EXPECT_TRUE(is_burr_in_view(bone, tissues_, view_of_well(18.5), in_well_mm));
    EXPECT_FALSE(is_burr_in_view(bone, tissues_, view_of_well(22.0), in_well_mm));
    EXPECT_FALSE(is_burr_in_view(bone, tissues_, view_of_well(180.0), in_well_mm)) << "through the floor";
    EXPECT_FALSE(is_burr_in_view(bone_, tissues_, view_of_well(0.0), in_well_mm)) << "before it was milled";
    EXPECT_TRUE(is_burr_in_view(bone_, tissues_, view_of_well(0.0), {0.0, 0.0, top_mm + 0.2}));
}

TEST_F(Well, ShowsItThroughWhatIsFaded) {
    tissues_[0].opacity = 0.4;
    EXPECT_TRUE(is_burr_in_view(bone_, tissues_, view_of_well(50.0), in_well_mm));
    tissues_[0].opacity = 0.6;
    EXPECT_FALSE(is_burr_in_view(bone_, tissues_, view_of_well(50.0), in_well_mm));
}

TEST_F(Well, ShowsNothingThatIsOutsideOfThePicture) {
    const Bone bone = milled();
    const auto sees = [&](double aside_deg, bool is_right) {
        return is_burr_in_view(bone, tissues_, view_of_well(0.0, aside_deg, is_right), in_well_mm);
    };
    EXPECT_TRUE(sees(14.9, false)) << "half of 30 degrees, from top to bottom";
    EXPECT_TRUE(sees(-14.9, false));
    EXPECT_FALSE(sees(15.1, false));
    EXPECT_FALSE(sees(-15.1, false));
    // atan(16 / 9 tan 15) = 25.47 degrees from left to right.
    EXPECT_TRUE(sees(25.3, true));
    EXPECT_TRUE(sees(-25.3, true));
    EXPECT_FALSE(sees(25.6, true));
    EXPECT_FALSE(sees(180.0, true)) << "behind the eye";
}

TEST_F(Well, CountsTheTimeInWhichBoneIsTaken) {
    const testing::TemporaryFolder folder;
    testing::WrittenSession written(folder / "a.pcap",
                                    {.scene_name = "cube", .burrs = {Burr{}}, .tissues = tissues_}, bone_);
    ToolState tool{.burr_position_mm = in_well_mm, .spindle_on = true};
    int voxels = 0;
    const auto frame = [&](bool cuts) {
        if (cuts) {
            const double x_mm = -3.1 + well_spacing_mm * voxels++;
            written.cut([&](const glm::dvec3& at) {
                return std::abs(at.x - x_mm) < 0.05 && std::abs(at.y - 3.1) < 0.05 && at.z < -3.0;
            });
        }
        written.frame(tool);
        tool.time_s += 0.05;
    };
    frame(false);
    for (int i = 0; i < 2; ++i) frame(true);  // nobody has looked yet
    written.cut(is_in_well);
    written.look(view_of_well(0.0));
    for (int i = 0; i < 4; ++i) frame(true);
    for (int i = 0; i < 9; ++i) frame(false);
    written.look(view_of_well(30.0));
    for (int i = 0; i < 4; ++i) frame(false);
    for (int i = 0; i < 3; ++i) frame(true);
    written.finish();
    const MotionMetrics motion = motion_metrics(read_trace(folder / "a.pcap", [](double) {}));
    ASSERT_TRUE(motion.burr_in_view_share);
    EXPECT_NEAR(*motion.burr_in_view_share, 4.0 / 7.0, 1e-9);
}

}  // namespace
}  // namespace osteomill
