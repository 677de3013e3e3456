#include "studies/render/full_rate/carve_upload.h"

#include <epoxy/gl.h>

#include <stdexcept>

#include "render_client/volume/textures/bone_textures.h"
#include "studies/render/made_bone.h"
#include "studies/render/phantom_session.h"

namespace osteomill::study {

namespace {

constexpr double ball_radius_mm = 2.5;

}  // namespace

CarveUpload upload_carves(const std::string& phantom, int times) {
    PhantomSession session(phantom);
    const Bone& bone = *session.bone();
    BoneTextures textures(bone, tissue_colours(session.session()->tissues));
    CarveUpload found{.plan = textures.plan(), .textures = textures.sizes()};

    Bone with_ball = bone;
    const auto ball = carve_sphere(with_ball, session.poll().tool->burr_position_mm, ball_radius_mm);
    if (ball.empty()) throw std::runtime_error("the burr meets no bone in the phantom " + phantom);
    found.bricks_of_ball = ball.size();
    FrameStopwatch by_ball;
    const auto take_over = [&](const Bone& now, std::span<const BrickChange> changes) {
        textures.update(now, changes);
        glFinish();
    };
    for (int time = 0; time < times; ++time) {
        by_ball.time([&] { take_over(with_ball, ball); });
        take_over(bone, ball);  // Not measured, but without it there would be nothing new.
    }
    found.by_ball = by_ball.frames();

    session.mill(true);
    FrameStopwatch by_frame;
    for (int time = 0; time < times; ++time) {
        session.step();
        const LinkUpdate update = session.poll();
        by_frame.time([&] { take_over(bone, update.changes); });
    }
    found.by_frame = by_frame.frames();
    return found;
}

}  // namespace osteomill::study
