#include "render_client/dataset/camera_file.h"

#include <glm/gtc/quaternion.hpp>

#include "common/scene/scene_file.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace osteomill::camera_file_test {
namespace {

class CameraFileTest : public ::testing::Test {
  protected:
    std::vector<DatasetCamera> read(const std::string& text) const {
        std::ofstream(folder_.path() / "cameras.toml") << text;
        return read_cameras(folder_.path() / "cameras.toml");
    }
    std::string refusal(const std::string& text) const {
        return testing::message_of<std::runtime_error>([&] { read(text); });
    }

    testing::TemporaryFolder folder_;
};

TEST_F(CameraFileTest, HasWhatIsWrittenAndElseTheDefaults) {
    const auto cameras = read(R"([[cameras]]
name = "a"
width_px = 320
height_px = 200
intrinsics = [[400, 0, 150], [0, 410, 99], [0, 0, 1]]
eye_mm = [0, -50, 0]
target_mm = [0, 0, 0]
[[cameras]]
name = "b"
)");
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].pinhole.size_px, glm::ivec2(320, 200));
    EXPECT_EQ(cameras[0].pinhole.focal_px, glm::dvec2(400, 410));
    EXPECT_EQ(cameras[0].pinhole.centre_px, glm::dvec2(150, 99));
    const Pose pose = cameras[0].pose_at(3.0, {});
    EXPECT_EQ(pose.position_mm, glm::dvec3(0, -50, 0));
    EXPECT_NEAR(glm::distance(pose.rotation * glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0)), 0.0, 1e-12);
    EXPECT_NEAR(glm::distance(pose.rotation * glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)), 0.0, 1e-12);
    EXPECT_EQ(cameras[1].pinhole.size_px, glm::ivec2(640, 480));
    EXPECT_EQ(cameras[1].pose_at(3.0, {.position_mm = {1, 2, 3}}).position_mm, glm::dvec3(1, 2, 3));
}

// A point on the line of sight is in the middle of both pictures where they converge, and f b (1/z - 1/c)
// further to the right in the left one elsewhere (stereo.h).
TEST_F(CameraFileTest, MakesAPairThatConverges) {
    const auto cameras = read(R"([[cameras]]
name = "s"
intrinsics = [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]]
eye_mm = [0, -100, 0]
target_mm = [0, 0, 0]
baseline_mm = 6
convergence_mm = 100
)");
    ASSERT_EQ(cameras.size(), 2u);
    EXPECT_EQ(cameras[0].name, "s_left");
    EXPECT_EQ(cameras[1].name, "s_right");
    const auto u_of = [&](const DatasetCamera& camera, double depth_mm) {
        const Pose pose = camera.pose_at(0.0, {});
        const glm::dvec3 seen =
            glm::conjugate(pose.rotation) * (glm::dvec3(0, depth_mm - 100.0, 0) - pose.position_mm);
        return camera.pinhole.focal_px.x * seen.x / seen.z + camera.pinhole.centre_px.x;
    };
    for (const double depth_mm : {60.0, 100.0, 150.0})
        EXPECT_NEAR(u_of(cameras[0], depth_mm) - u_of(cameras[1], depth_mm),
                    500.0 * 6.0 * (1.0 / depth_mm - 1.0 / 100.0), 1e-9);
    EXPECT_NEAR(u_of(cameras[0], 100.0), 319.5, 1e-9);
}

TEST_F(CameraFileTest, MovesAlongAPath) {
    std::ofstream(folder_.path() / "path.csv") << "time_s,x,y,z,qx,qy,qz,qw\n"
                                                  "1,0,0,0,0,0,0,1\n"
                                                  "2,10,0,0,0,0,1,0\n";
    const DatasetCamera camera = read("[[cameras]]\nname = \"p\"\npath = \"path.csv\"\n").front();
    EXPECT_EQ(camera.pose_at(0.0, {}).position_mm, glm::dvec3(0.0));
    EXPECT_EQ(camera.pose_at(9.0, {}).position_mm, glm::dvec3(10, 0, 0));
    EXPECT_NEAR(glm::distance(camera.pose_at(1.25, {}).position_mm, glm::dvec3(2.5, 0, 0)), 0.0, 1e-12);
    // Half of half a turn about z.
    const glm::dvec3 turned = camera.pose_at(1.5, {}).rotation * glm::dvec3(1, 0, 0);
    EXPECT_NEAR(glm::distance(turned, glm::dvec3(0, 1, 0)), 0.0, 1e-12);
}

TEST_F(CameraFileTest, FollowsTheTraineeInPairsToo) {
    const auto cameras = read(R"([[cameras]]
name = "eyes"
view = "trainee"
baseline_mm = 4
convergence_mm = 80
[[cameras]]
name = "fixed"
view = "trainee"
intrinsics = [[500, 0, 319.5], [0, 500, 239.5], [0, 0, 1]]
)");
    ASSERT_EQ(cameras.size(), 3u);
    // Looks along y, x to the right.
    const Viewpoint trainee{.eye_mm = {1, -50, 0},
                            .rotation = looking_at({}, {0, 1, 0}, {0, 0, 1}).rotation,
                            .field_of_view_rad = 2.0 * std::atan(0.25)};
    const Pose first{.position_mm = {7, 7, 7}};
    EXPECT_EQ(cameras[2].pose_at(0.0, first).position_mm, first.position_mm) << "before it is recorded";
    EXPECT_EQ(cameras[2].pose_at(0.0, first, trainee).position_mm, trainee.eye_mm);
    EXPECT_EQ(cameras[2].pinhole_at(trainee).focal_px, glm::dvec2(500.0));
    EXPECT_NEAR(glm::distance(cameras[0].pose_at(0.0, first, trainee).position_mm, glm::dvec3(-1, -50, 0)),
                0.0, 1e-9);
    const Pinhole left = cameras[0].pinhole_at(trainee);
    EXPECT_NEAR(left.focal_px.x, 240.0 / 0.25, 1e-9);
    // A point that both see 80 mm ahead lies in the middle: 2 mm to the right of the left eye.
    EXPECT_NEAR(left.focal_px.x * 2.0 / 80.0 + left.centre_px.x, 319.5, 1e-9);
    EXPECT_EQ(cameras_named("trainee").front().pose_at(0.0, first, trainee).position_mm, trainee.eye_mm);
}

TEST_F(CameraFileTest, SaysWhatIsWrongInOneLine) {
    using ::testing::HasSubstr;
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\nview = \"nurse\"\n"), HasSubstr("trainee"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\nview = \"trainee\"\neye_mm = [0, 0, 0]\n"),
                HasSubstr("target_mm"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\nview = \"trainee\"\npath = \"p.csv\"\n"),
                HasSubstr("stands in place of"));
    EXPECT_THAT(refusal(""), HasSubstr("has no camera"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a/b\"\n"), HasSubstr("'a/b' must be of letters"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\n[[cameras]]\nname = \"a\"\n"),
                HasSubstr("two cameras called 'a'"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\neye_mm = [0, 0, 0]\n"), HasSubstr("target_mm"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\nconvergence_mm = 5\n"), HasSubstr("baseline_mm"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\nintrinsics = [[1, 2, 3], [0, 1, 3], [0, 0, 1]]\n"),
                HasSubstr("[[fx, 0, cx]"));
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\nzoom = 2\n"), HasSubstr("zoom"));
    std::ofstream(folder_.path() / "path.csv") << "0,0,0,0,0,0,0,1\n0,0,0,0,0,0,0,1\n";
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\npath = \"path.csv\"\n"),
                HasSubstr("path.csv:2: its time"));
    std::ofstream(folder_.path() / "path.csv") << "0,0,0,0,0,0,0\n";
    EXPECT_THAT(refusal("[[cameras]]\nname = \"a\"\npath = \"path.csv\"\n"), HasSubstr("has 7 cells"));
}

}  // namespace
}  // namespace osteomill::camera_file_test
