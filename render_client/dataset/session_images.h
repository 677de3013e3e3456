// Images of one session: its bone's textures, and for each camera the picture and the surfaces
// that it sees.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render_client/dataset/camera_file.h"
#include "render_client/dataset/imaged_session.h"
#include "render_client/dataset/known_shanks.h"
#include "render_client/dataset/surface_labels.h"
#include "render_client/volume/passes/scene_picture.h"

namespace osteomill {

/// A camera's images of one instant.
struct CameraImages {
    Pose camera{};
    Pinhole pinhole{};
    Picture colour;
    SurfaceImage surface{};
    std::vector<std::uint8_t> labels{};
};

/// A recorded tool as a solid object. Its burr is turned by its speed times the session time.
DrawnTool tool_as_thing(const ToolState& state, const SessionInfo& session, const KnownShanks& shanks = {});

class SessionImages {
  public:
    /// Draws `session`, which outlives it and has a bone. Tissues are solid, but for those of opacity 0,
    /// which are left out. Throws std::runtime_error if the bone cannot be drawn. Calls need a context
    /// current.
    SessionImages(ImagedSession& session, std::span<const DatasetCamera> cameras, const SceneAppearance& look,
                  const TextureLimits& limits);

    /// Takes up what changed since the last call, up to the session's instant. The first with a tool fixes
    /// the first view.
    void follow();
    const BoneTextures& textures() const { return textures_; }
    /// Draws the instant that was followed last. `wants_colour` and `wants_surface` leave out images that
    /// nobody reads.
    CameraImages draw(std::size_t camera, bool wants_colour, bool wants_surface);

  private:
    struct View {
        View(const DatasetCamera& its, BoneRenderer& renderer)
            : camera(its), picture(renderer, its.pinhole.size_px), surface(its.pinhole.size_px) {}
        DatasetCamera camera;
        ScenePicture picture;
        SurfacePass surface;
    };
    void take_structures();

    ImagedSession& session_;
    RaycastRenderer renderer_;
    KnownShanks shanks_;
    std::vector<Tissue> tissues_;
    BoneTextures textures_;
    std::vector<std::unique_ptr<View>> views_;
    std::size_t structures_ = 0;  // how many of the session's have been taken over
    bool has_first_view_ = false;
    Pose first_view_;
};

}  // namespace osteomill
