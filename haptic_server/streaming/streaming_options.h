// Settings of a streaming server: its address, its clients, its frame rate, and its recording.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "common/recording/pcap_file.h"
#include "common/recording/recording_writer.h"
#include "common/session/tick_sample.h"
#include "haptic_server/streaming/connection_quota.h"
#include "haptic_server/streaming/operator_list.h"
#include "simulation/exchange/sample_log.h"

namespace osteomill {

class TlsContext;

/// A recording of the shown session.
struct RecordTo {
    std::filesystem::path file;
    /// When the session's time is zero; with waits_for_client the time of the first packet, and states say
    /// when they were taken (ToolState::taken_unix_ns).
    Stamp began;
    bool with_ticks = true;
    /// The queue in which the haptic loop leaves them, for the recording alone; null: none.
    SampleQueue<TickSample>* ticks = nullptr;
    /// When the recording can no longer be written, and when it can again: a line for people. Any thread.
    /// The log has them in any case.
    RecordingWriter::OnNews on_news{};
};

struct StreamingOptions {
    bool listens = true;  ///< false: nobody is served, there is only a recording
    std::string address = "127.0.0.1";
    std::uint16_t port = 7010;          ///< 0 lets the system choose; see StreamingServer::port
    std::shared_ptr<TlsContext> tls{};  ///< null: clients are served in the clear
    bool insecure_network = false;      ///< in the clear, and yet to other machines, too
    /// Who may move the tool, if a client does; nothing: every client. Names nobody without TLS.
    std::optional<OperatorList> operators{};
    /// Two round trips and some milliseconds of arithmetic; a client that does not hear from its server for
    /// 5 s gives up.
    std::chrono::milliseconds handshake_deadline{3000};
    /// Places for unidentified connections, see ConnectionQuota.
    std::size_t unidentified_quota = osteomill::unidentified_quota();
    double frame_rate_hz = 30.0;
    /// Frames go out when show_frame() is called instead, and a recording waits for its disk: for sessions
    /// that run on a clock of their own.
    bool paced_by_session = false;
    /// The session's time begins with a client, see StreamingServer::has_client_begun().
    bool waits_for_client = false;
    std::optional<RecordTo> record{};
};

}  // namespace osteomill
