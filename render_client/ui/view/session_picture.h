// A session made visible: takes in a source's updates, keeps textures and camera, draws picture and panels.
// The common part of a window and an offscreen run.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "common/session/operator_command.h"
#include "common/session/tool_state.h"
#include "render_client/link/session_source.h"
#include "render_client/ui/panels/imgui_context.h"
#include "render_client/ui/panels/overlay.h"
#include "render_client/ui/run_json.h"
#include "render_client/ui/view/bone_on_screen.h"
#include "render_client/ui/view/fixture_borders.h"
#include "render_client/ui/view/session_sight.h"
#include "render_client/ui/view/shown_tool.h"
#include "render_client/volume/gl/offscreen_context.h"
#include "render_client/volume/passes/bone_renderer.h"
#include "render_client/volume/passes/stereo_picture.h"

namespace osteomill {

// Changes of a session since the last drawn frame.

/// A session as the last frame showed it, beside its bone.
struct DrawnSession {
    LinkUpdate link{};
    std::optional<ToolState> tool{};
    std::optional<OperatorCommand> operator_command{};
    std::optional<int> preparation_percent{};  ///< progress of a bone or an appearance; none: all is ready
};

enum class SessionNews {
    none,
    figures,  ///< only the time, the rates, the delay
    change    ///< something that moves, appears or goes
};

/// Changes in a poll, against the session as it was drawn.
SessionNews news_since(const DrawnSession& drawn, const LinkUpdate& link,
                       const std::optional<ToolState>& tool,
                       const std::optional<OperatorCommand>& operator_command,
                       const std::optional<int>& preparation_percent);

enum class FrameQuality {
    full,      ///< every frame at full quality, however long it takes
    on_demand  ///< coarser under motion where it must be to keep the rate of frames, full soon after
};

class SessionPicture {
  public:
    SessionPicture(SessionSource& source, ImguiContext& panels, const glm::ivec2& size_px,
                   FrameQuality quality = FrameQuality::full,
                   RendererChoice renderer = RendererChoice::raycast, const ShadingSettings& look = {},
                   const StereoSettings& stereo = {});

    /// Limits the textures of bones that come from now on.
    void limit_textures(const TextureLimits& limits) { bone_.limit(limits); }
    /// Makes the memory of large textures from now on; must outlive the picture.
    void make_storage_by(gl::StorageThread& thread) { bone_.make_storage_by(thread); }

    /// On demand, a call of take_in spends at most this time on preparing textures, and at least one step.
    /// With a frame's drawing it stays well below a noticeable wait.
    void prepare_for(std::chrono::milliseconds slice) { preparing_slice_ = slice; }

    /// Polls the source and brings the textures up to date: at full quality to the end, on demand for some
    /// milliseconds, so that those of a large bone take many calls. Returns the changes since the last draw;
    /// a picture that can be refined counts as changed.
    SessionNews take_in();
    /// Draws bone, tool and panels; leaves the framebuffer bound. `elapsed_s`: since the last frame.
    const gl::Framebuffer& draw(double elapsed_s);
    /// Copies the last picture to the window whose context is current.
    void copy_to_window() const { picture_.copy_to_window(); }

    /// The duration of the whole frame, waiting excluded; it controls quality on demand.
    void frame_took(double frame_s) { picture_.frame_took(frame_s); }
    PictureQuality quality() const { return picture_.quality(); }

    void resize(const glm::ivec2& size_px);
    const glm::ivec2& size_px() const { return size_px_; }

    Camera& camera() { return camera_; }
    const Camera& camera() const { return camera_; }
    /// The first view again (first_view.h).
    void reset_camera() { camera_ = first_view_; }
    /// Sets the first view's magnification.
    void set_first_magnification(double factor) { first_magnification_ = factor; }
    /// A new appearance needs new textures, like a new bone; the view stays, and so does the picture until
    /// they are ready. Throws std::invalid_argument for an invalid transfer function.
    void set_shading(const ShadingSettings& look);
    ViewSettings& view() { return view_; }
    const ViewSettings& view() const { return view_; }
    /// From now on panels accept a person's requests of the session.
    void offer_controls() { takes_requests_ = true; }
    /// While there is no session, one can be started with this, which outlives the picture.
    void offer_start(StartScreen& start) { start_ = &start; }
    /// The requests since the last call.
    SessionRequests take_requests() { return std::exchange(requests_, {}); }
    void show_operator(const std::optional<OperatorCommand>& command) { operator_command_ = command; }

    /// Shows the tool there instead of where the session has it; nothing: no longer.
    void show_tool_at(const std::optional<ToolPose>& pose) { tool_.show_at(pose); }

    bool has_bone() const { return bone_.textures() != nullptr; }
    /// The share of the textures that is ready, in percent, while the bone or an appearance is prepared.
    std::optional<int> preparation_percent() const;
    /// Whether the burr turns in the picture: only while the source sends states.
    bool has_turning_burr() const { return tool_.has_turning_burr(); }
    /// Why the present bone cannot be drawn; empty while it can.
    const std::string& bone_problem() const { return bone_.problem(); }
    const LinkUpdate& link() const { return link_; }
    /// Null until a server has said hello.
    const SessionInfo* session() const { return source_.session(); }
    /// Nothing if it is not known how the tool is now.
    std::optional<ToolState> tool() const { return elements().tool ? tool_.state() : std::nullopt; }
    SessionSight sight() const;
    SightElements elements() const { return elements_of(sight()); }

    /// The measurements so far, with the bone's present checksum. The caller adds the frame times.
    RenderReport report() const;

  private:
    void take_in_bone(bool first_of_tool);
    bool is_of_another_session() const;
    void forget_session();
    void find_first_view();
    void take_in_structure(const Structure& structure);
    void take_in_fixtures();
    void forget_structures();
    void work_on_bone();
    void show_other_textures(DrawingCost cost);
    SessionNews news() const;
    void ask_for_ct();
    /// Null if none is wanted, or there is nothing to see in it.
    const gl::Framebuffer* draw_inset(const std::optional<DrawnTool>& tool, const SceneAppearance& look);

    SessionSource& source_;
    ImguiContext& panels_;
    std::unique_ptr<BoneRenderer> renderer_;
    BoneOnScreen bone_;
    FrameQuality frame_quality_;
    std::chrono::milliseconds preparing_slice_{15};
    StereoPicture picture_;
    FixtureBorders fixture_borders_;
    RendererChoice renderer_choice_;
    std::optional<InsetView> inset_;  ///< while it is shown
    glm::ivec2 size_px_;
    Camera camera_;
    Camera first_view_;
    double first_magnification_ = 1.0;
    bool has_taken_bone_ = false;
    bool has_first_view_ = false;
    std::string scene_name_;  ///< belongs to the bone that is shown, like the grid
    Grid grid_;
    LinkUpdate link_;
    ShownTool tool_;
    DrawnSession drawn_;  ///< as the last frame showed it
    SessionSight drawn_sight_ = SessionSight::none;
    bool has_undrawn_bone_ = true;
    ToolHistory history_;
    std::optional<OperatorCommand> operator_command_;
    ViewSettings view_;
    SlicesView slices_;
    std::uint64_t bone_version_ = 0;
    std::uint64_t ct_requested_in_ = 0;  // which connection; 0: none
    SessionRequests requests_;
    bool takes_requests_ = false;
    StartScreen* start_ = nullptr;
    double frame_s_ = 0.0;  ///< between frames, in the mean over the last ten or so
    std::uint64_t dirty_bricks_uploaded_ = 0;
};

}  // namespace osteomill
