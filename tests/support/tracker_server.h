// A tracker for tests: the library's own server socket, which sends a test's messages to every client.
#pragma once

#include <openigtlink/igtlServerSocket.h>
#include <openigtlink/igtlStringMessage.h>
#include <openigtlink/igtlTransformMessage.h>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <string>

namespace osteomill::testing {

class TrackerServer {
  public:
    /// Listens on a free port, or on `port`.
    explicit TrackerServer(int port = 0) : listener_(igtl::ServerSocket::New()) {
        if (listener_->CreateServer(port) < 0) throw std::runtime_error("no port for a tracker");
    }
    ~TrackerServer() { hang_up(); }

    int port() { return listener_->GetServerPort(); }
    /// Waits for a client.
    bool accept(unsigned long longest_ms = 120'000) {
        client_ = listener_->WaitForConnection(longest_ms);
        return client_.IsNotNull();
    }
    void hang_up() {
        if (client_.IsNotNull()) client_->CloseSocket();
        client_ = nullptr;
    }

    /// False if nobody is connected any more.
    bool send(const std::string& name, const glm::dvec3& position_mm, const glm::dquat& turn,
              double stamp_s) {
        auto message = igtl::TransformMessage::New();
        message->SetDeviceName(name.c_str());
        const glm::dmat3 axes = glm::mat3_cast(turn);
        igtl::Matrix4x4 matrix;
        igtl::IdentityMatrix(matrix);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                matrix[row][column] = static_cast<float>(axes[column][row]);
            matrix[row][3] = static_cast<float>(position_mm[row]);
        }
        message->SetMatrix(matrix);
        auto stamp = igtl::TimeStamp::New();
        stamp->SetTime(stamp_s);
        message->SetTimeStamp(stamp);
        message->Pack();
        return send_bytes(message->GetPackPointer(), message->GetPackSize());
    }
    bool send(const std::string& name, const std::string& text) {
        auto message = igtl::StringMessage::New();
        message->SetDeviceName(name.c_str());
        message->SetString(text.c_str());
        message->Pack();
        return send_bytes(message->GetPackPointer(), message->GetPackSize());
    }
    bool send_bytes(const void* bytes, int count) {
        return client_.IsNotNull() && client_->Send(bytes, count) == 1;
    }

  private:
    igtl::ServerSocket::Pointer listener_;
    igtl::ClientSocket::Pointer client_;
};

}  // namespace osteomill::testing
