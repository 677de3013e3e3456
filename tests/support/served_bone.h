// A bone that a thread carves and a streaming server shows, as in the haptic server but without haptics.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "haptic_server/streaming/live_session.h"
#include "haptic_server/streaming/streaming_server.h"
#include "tests/support/eventually.h"
#include "tests/support/random_carving.h"
#include "tests/support/speckled_bone.h"

namespace osteomill::testing {

class ServedBone {
  public:
    explicit ServedBone(std::uint16_t port = 0, bool takes_operator = false, std::uint32_t seed = 8,
                        std::optional<RecordTo> record = std::nullopt,
                        std::shared_ptr<TlsContext> tls = nullptr)
        : random_(seed),
          bone_(make_speckled_bone(random_, {.grid = {.size_voxels = {160, 128, 64}}})),
          changes_(1 << 18, bone_.shared_content()) {
        Scene scene;
        scene.name = "test scene";
        scene.burrs = {Burr{.name = "round 1.5", .diameter_mm = 1.5}, Burr{.name = "round 5"}};
        scene.tissues = {Tissue{.label = 2, .name = "nerve", .is_protected = true}};
        server_ = std::make_unique<StreamingServer>(
            StreamingOptions{.port = port,
                             .tls = std::move(tls),
                             .handshake_deadline = std::chrono::milliseconds(300),
                             .unidentified_quota = 48,
                             .record = std::move(record)},
            session_info(scene, takes_operator, 3.3, "0.0.test"), bone_, shown_,
            takes_operator ? &operator_ : nullptr);
        server_->start();
    }
    ~ServedBone() { stop(); }
    ServedBone(const ServedBone&) = delete;
    ServedBone& operator=(const ServedBone&) = delete;

    void start_carving() {
        is_carving_ = true;
        carver_ = std::thread([this] {
            while (is_carving_) {
                carve(20);
                std::this_thread::sleep_for(std::chrono::milliseconds(1));  // as a loop at 1 kHz would
            }
        });
    }
    void stop_carving() {
        is_carving_ = false;
        if (carver_.joinable()) carver_.join();
    }
    /// While no thread carves.
    void carve(int runs) {
        for (int i = 0; i < runs; ++i) carve_somewhere(bone_, random_, changes_);
        changes_.resend_overflowed(bone_);
        ToolState tool;
        tool.time_s = time_s_ += 0.001;
        tool.force_n = {0.5, 0.0, 0.0};
        tool_.back() = tool;
        tool_.publish();
    }
    /// Ends as the haptic server does: milling first, then whatever still waits, then streaming.
    void stop() {
        if (!server_) return;
        stop_carving();
        eventually([this] {
            changes_.resend_overflowed(bone_);
            return !changes_.has_overflowed();
        });
        server_->stop();
        mirror_checksum_ = server_->mirror_checksum();
        server_.reset();
    }

    std::uint16_t port() const { return server_->port(); }
    /// After stop().
    std::uint64_t mirror_checksum() const { return mirror_checksum_; }
    /// While nobody carves.
    const Bone& bone() const { return bone_; }
    /// The operator's newest command; nothing while there is no operator.
    const std::optional<OperatorCommand>& operator_command() {
        operator_.refresh();
        return operator_.front().command;
    }

  private:
    std::mt19937 random_;
    Bone bone_;
    ChangeQueue changes_;
    TripleBuffer<ToolState> tool_;
    LiveSession shown_{tool_, changes_};
    OperatorChannel operator_;
    double time_s_ = 0.0;
    std::unique_ptr<StreamingServer> server_;
    std::uint64_t mirror_checksum_ = 0;
    std::atomic<bool> is_carving_{false};
    std::thread carver_;
};

}  // namespace osteomill::testing
