// Haply's service for tests: a WebSocket server that speaks its documented messages, and that can fall
// silent, talk nonsense, lose its devices and be killed. One client at a time. Its Inverse3 follows commands
// and feels the forces that it receives.
#pragma once

#include <sys/socket.h>

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

namespace osteomill::testing {

class HaplyService {
  public:
    /// The devices' state, in the service's axes and units.
    struct Devices {
        bool has_arm = true;
        std::string arm_id = "049D";
        glm::dvec3 position_m{0.0};
        std::optional<glm::dvec3> velocity_m_per_s;
        bool is_calibrated = true;
        bool has_grip = true;
        glm::dquat turn{1.0, 0.0, 0.0, 0.0};
        bool a = false;
        bool b = false;
        bool c = false;
    };
    enum class Mood { answers, silent, garbage };

    /// Version 3.5 numbers its sessions and calls the components of a force "vector"; 3.1 calls them
    /// "values".
    explicit HaplyService(bool is_new = true, std::uint16_t port = 0) : is_new_(is_new), port_(port) {
        live();
    }
    ~HaplyService() { kill(); }

    std::uint16_t port() const { return port_; }

    /// Acts as if its process had ended: the connection is gone, and nobody listens.
    void kill() {
        stops_ = true;
        ::shutdown(listening_.load(), SHUT_RDWR);
        ::shutdown(talking_.load(), SHUT_RDWR);
        if (thread_.joinable()) thread_.join();
        const std::lock_guard lock(mutex_);
        force_n_.reset();
    }
    void live() {
        stops_ = false;
        auto context = std::make_shared<boost::asio::io_context>();
        auto acceptor = std::make_shared<boost::asio::ip::tcp::acceptor>(
            *context, boost::asio::ip::tcp::endpoint(boost::asio::ip::address_v4::loopback(), port_));
        port_ = acceptor->local_endpoint().port();
        listening_ = acceptor->native_handle();
        thread_ = std::thread([this, context, acceptor] { serve(*context, *acceptor); });
    }

    void set(const Devices& devices) {
        const std::lock_guard lock(mutex_);
        devices_ = devices;
    }
    /// Called for each answer, from now on: with the seconds since the first of them, and the newest force.
    using Motion = std::function<Devices(double time_s, const glm::dvec3& force_n)>;
    void set(Motion motion) {
        const std::lock_guard lock(mutex_);
        motion_ = std::move(motion);
        began_.reset();
    }
    void set(Mood mood) { mood_ = mood; }
    /// Sent in the place of a state while it talks garbage.
    void set_garbage(const std::string& text) {
        const std::lock_guard lock(mutex_);
        garbage_ = text;
    }

    /// The newest force, N; nullopt before the first of a life.
    std::optional<glm::dvec3> force_n() const {
        const std::lock_guard lock(mutex_);
        return force_n_;
    }
    double largest_force_n() const {
        const std::lock_guard lock(mutex_);
        return largest_force_n_;
    }
    /// To a larger force, between two messages of one connection.
    double largest_jump_n() const {
        const std::lock_guard lock(mutex_);
        return largest_jump_n_;
    }
    /// Messages that nothing documented could be made of.
    int odd_messages() const { return odd_; }
    int messages() const { return messages_; }
    int connections() const { return connections_; }

  private:
    using Stream = boost::beast::websocket::stream<boost::asio::ip::tcp::socket>;

    void serve(boost::asio::io_context& context, boost::asio::ip::tcp::acceptor& acceptor) {
        while (!stops_) {
            boost::system::error_code error;
            boost::asio::ip::tcp::socket socket(context);
            acceptor.accept(socket, error);
            if (error) continue;
            Stream stream(std::move(socket));
            stream.next_layer().set_option(boost::asio::ip::tcp::no_delay(true), error);
            talking_ = stream.next_layer().native_handle();
            stream.accept(error);
            if (!error) {
                ++connections_;
                converse(stream);
            }
            talking_ = -1;
        }
    }
    void converse(Stream& stream) {
        boost::system::error_code error;
        say(stream, true, error);
        boost::beast::flat_buffer buffer;
        std::optional<glm::dvec3> before_n;
        while (!error && !stops_) {
            buffer.clear();
            stream.read(buffer, error);
            if (error) return;
            ++messages_;
            hear(boost::beast::buffers_to_string(buffer.data()), before_n);
            say(stream, false, error);
        }
    }
    void hear(const std::string& text, std::optional<glm::dvec3>& before_n) {
        const auto message = nlohmann::json::parse(text, nullptr, false);
        if (message.is_object() && message.contains("session")) return;
        try {
            const auto& device = message.at("inverse3").at(0);
            const auto& force =
                device.at("commands").at("set_cursor_force").at(is_new_ ? "vector" : "values");
            const glm::dvec3 force_n(force.at("x").get<double>(), force.at("y").get<double>(),
                                     force.at("z").get<double>());
            const std::lock_guard lock(mutex_);
            if (device.at("device_id") != devices_.arm_id) {
                ++odd_;
                return;
            }
            if (before_n && glm::length(force_n) > glm::length(*before_n))
                largest_jump_n_ = std::max(largest_jump_n_, glm::length(force_n - *before_n));
            largest_force_n_ = std::max(largest_force_n_, glm::length(force_n));
            force_n_ = before_n = force_n;
        } catch (const nlohmann::json::exception&) {
            ++odd_;
        }
    }
    void say(Stream& stream, bool is_first, boost::system::error_code& error) {
        std::string text;
        {
            const std::lock_guard lock(mutex_);
            if (mood_ == Mood::silent && !is_first) return;
            if (motion_) {
                const auto now = std::chrono::steady_clock::now();
                if (!began_) began_ = now;
                devices_ = motion_(std::chrono::duration<double>(now - *began_).count(),
                                   force_n_.value_or(glm::dvec3(0.0)));
            }
            text = mood_ == Mood::garbage ? garbage_ : state(is_first).dump();
        }
        stream.write(boost::asio::buffer(text), error);
    }
    nlohmann::json state(bool is_first) const {
        const auto vector = [](const glm::dvec3& v) {
            return nlohmann::json{{"x", v.x}, {"y", v.y}, {"z", v.z}};
        };
        nlohmann::json message{{"inverse3", nlohmann::json::array()},
                               {"verse_grip", nlohmann::json::array()},
                               {"wireless_verse_grip", nlohmann::json::array()}};
        if (is_first && is_new_) message["session_id"] = 7;
        const Devices& d = devices_;
        if (d.has_arm) {
            nlohmann::json arm{{"device_id", d.arm_id},
                               {"state",
                                {{"cursor_position", vector(d.position_m)},
                                 {"angular_position", {{"a0", 0.0}, {"a1", 0.0}, {"a2", 0.0}}},
                                 {"mode", "force"}}},
                               {"status",
                                {{"calibrated", d.is_calibrated},
                                 {"in_use", true},
                                 {"power_supply", true},
                                 {"ready", true},
                                 {"started", true}}}};
            if (d.velocity_m_per_s) arm["state"]["cursor_velocity"] = vector(*d.velocity_m_per_s);
            if (is_first) arm["config"] = {{"type", "inverse3"}, {"handedness", "right"}, {"port", "COM13"}};
            message["inverse3"].push_back(arm);
        }
        if (d.has_grip)
            message["wireless_verse_grip"].push_back(
                {{"device_id", "61548"},
                 {"state",
                  {{"orientation", {{"w", d.turn.w}, {"x", d.turn.x}, {"y", d.turn.y}, {"z", d.turn.z}}},
                   {"buttons", {{"a", d.a}, {"b", d.b}, {"c", d.c}}},
                   {"hall", 0}}},
                 {"status", {{"connected", true}, {"awake", true}, {"ready", true}}}});
        return message;
    }

    const bool is_new_;
    std::uint16_t port_;
    mutable std::mutex mutex_;
    Devices devices_;
    Motion motion_;
    std::optional<std::chrono::steady_clock::time_point> began_;
    std::string garbage_ = R"({"inverse3":[{"device_id":"049D","state":{"cursor_position":{"x":"far"}}}]})";
    std::optional<glm::dvec3> force_n_;
    double largest_force_n_ = 0.0;
    double largest_jump_n_ = 0.0;
    std::atomic<Mood> mood_{Mood::answers};
    std::atomic<int> odd_{0};
    std::atomic<int> messages_{0};
    std::atomic<int> connections_{0};
    std::atomic<bool> stops_{false};
    std::atomic<int> listening_{-1};
    std::atomic<int> talking_{-1};
    std::thread thread_;
};

}  // namespace osteomill::testing
