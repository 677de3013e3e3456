#include <boost/asio/io_context.hpp>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <optional>

#include "common/bone/patient_space.h"
#include "common/wire/sealed_frame.h"
#include "haptic_server/streaming/client_connection.h"
#include "haptic_server/streaming/client_message.h"
#include "tests/fuzz/small_session.h"
#include "tests/fuzz/targets.h"

namespace osteomill::fuzz {

namespace {

/// A connection whose other end is the fuzzer.
class ScriptedStream final : public Stream {
  public:
    explicit ScriptedStream(boost::asio::io_context& io) : socket_(io) {}

    void handshake(HandshakeHandler handler) override { handler({}); }
    void read(ReadHandler handler) override { reader_ = std::move(handler); }
    void write(std::string bytes, WriteHandler handler) override {
        decoder_.append({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
        const auto message = decoder_.next();
        require(message.has_value(), "the server wrote what is no frame");
        require(std::holds_alternative<v2::ServerFrame>(open_frame(*message)),
                "the server wrote a frame that cannot be opened");
        ++frames_written_;
        writer_ = std::move(handler);
    }
    void wait_until_taken(std::function<void()> handler) override { handler(); }
    std::string peer() override { return "192.0.2.1:7"; }
    boost::asio::ip::tcp::socket& socket() override { return socket_; }

    void arrive(Bytes bytes) {
        if (auto handler = std::exchange(reader_, nullptr)) handler({}, bytes);
    }
    /// The client reads what was written; the session may write more from within.
    void let_write() {
        while (auto handler = std::exchange(writer_, nullptr)) handler({});
    }
    std::size_t frames_written() const { return frames_written_; }

    /// Handlers keep the session alive, and the session the stream.
    void drop_handlers() {
        reader_ = nullptr;
        writer_ = nullptr;
    }

  private:
    boost::asio::ip::tcp::socket socket_;
    ReadHandler reader_;
    WriteHandler writer_;
    FrameDecoder decoder_;
    std::size_t frames_written_ = 0;
};

void require_possible(const OperatorCommand& command, std::size_t burrs) {
    require(is_finite(command.hand_target_mm), "the tool is moved to where no number is");
    require(std::abs(glm::length(command.spindle_axis) - 1.0) < 1e-9, "the spindle's axis is no unit vector");
    require(command.burr < burrs, "a burr that is not there");
}

}  // namespace

void server_session(Bytes input) {
    if (input.empty()) return;
    const std::size_t piece_bytes = 1 + input[0] % 128U;
    const bool reads_all = (input[0] & 128U) != 0;
    Bytes stream_bytes = input.subspan(1);

    static const Bone bone = small_bone();
    Bone carved = bone;
    const SessionInfo info = small_session_info();
    BoneReplica mirror(bone);
    static FramePackers packers;
    OperatorChannel output;
    ToolLease lease(output);
    constexpr ToolLease::ClientId id = 1;
    boost::asio::io_context io;
    const auto stream = std::make_shared<ScriptedStream>(io);
    const auto session =
        std::make_shared<ClientConnection>(stream, OutgoingFrames(to_message(info), mirror, packers));

    std::optional<Viewpoint> view;
    std::optional<std::string> ended;
    std::size_t messages = 0;
    session->start({.on_message =
                        [&](const v2::ClientFrame& frame) {
                            if (messages++ == 0) {
                                auto error = check_greeting(frame);
                                if (!error) session->serve();
                                return error;
                            }
                            const auto taken = take_client_message(frame,
                                                                   {.id = id,
                                                                    .outgoing = session->outgoing(),
                                                                    .answers = session->answers(),
                                                                    .lease = &lease,
                                                                    .burr_count = info.burrs.size(),
                                                                    .view = &view},
                                                                   {});
                            const auto* error = std::get_if<WireError>(&taken);
                            return error != nullptr ? std::optional(*error) : std::nullopt;
                        },
                    .on_closed = [&](const std::string& line, bool) { ended = line; }});
    stream->let_write();
    std::size_t states = 0;
    while (!stream_bytes.empty() && !ended) {
        const Bytes piece = stream_bytes.first(std::min(piece_bytes, stream_bytes.size()));
        stream_bytes = stream_bytes.subspan(piece.size());
        stream->arrive(piece);
        if (output.refresh() && output.front().command)
            require_possible(*output.front().command, info.burrs.size());
        require(!view || (is_finite(view->eye_mm) && view->field_of_view_rad > 0.0),
                "somebody looks from where no number is");
        // Meanwhile the milling loop removes the first brick, voxel by voxel.
        const std::size_t voxel = ++states % brick_voxel_count;
        carved.fractions(0)[voxel] = 0;
        require(mirror.apply({0, VoxelMask().set(voxel)}, carved.fractions(0)), "a mirror refused a change");
        session->outgoing().note(mirror.take_changes());
        session->show({.tool = {.time_s = 0.03 * static_cast<double>(states)}}, states % 30 == 0);
        if (reads_all) stream->let_write();
    }
    require(checksum(mirror.bone()) == checksum(carved), "a client changed the bone");
    if (ended) {
        require(!ended->empty() && ended->find('\n') == std::string::npos,
                "a client is dropped without one line that says why");
    } else {
        session->serve();
        session->outgoing().finish("the end");
        session->pump();
        stream->let_write();
        require(session->outgoing().is_finished(), "a session that cannot be ended");
        session->close("the end", false);
    }
    // Hello, begin, bricks, end, a state each time it was requested or a message was answered, and the
    // goodbye.
    require(stream->frames_written() <= states + messages + 8, "a client made the server write without end");
    stream->drop_handlers();
}

}  // namespace osteomill::fuzz
