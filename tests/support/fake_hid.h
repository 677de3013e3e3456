// USB HID without USB: devices that a test plugs in and out, and the reports between them and the driver. Any
// thread.
#pragma once

#include <algorithm>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "devices/hid/hid_transport.h"

namespace osteomill::testing {

using Report = std::vector<std::uint8_t>;

/// One device: a queue of reports to the host, and a function for each report from it (including the leading
/// byte).
struct FakeHidDevice {
    HidDeviceInfo info{"/dev/hidraw0", 0x1234, 0x0006, 0xFFAB, 0x0200, "Fake arm"};
    bool is_permitted = true;
    std::function<void(FakeHidDevice&, const Report&)> on_report = [](FakeHidDevice&, const Report&) {};
    std::deque<Report> to_host{};
    std::vector<Report> from_host{};

    void send(std::span<const std::uint8_t> report) { to_host.emplace_back(report.begin(), report.end()); }
};

class FakeHid final : public HidTransport {
  public:
    void plug(const FakeHidDevice& device) {
        const std::lock_guard lock(mutex_);
        devices_[device.info.path] = device;
        ++generation_;
    }
    void unplug(const std::string& path = "/dev/hidraw0") {
        const std::lock_guard lock(mutex_);
        devices_.erase(path);
        ++generation_;
    }
    /// Calls `use` with the device while nobody else touches it.
    template <typename Use>
    auto with(Use&& use, const std::string& path = "/dev/hidraw0") {
        const std::lock_guard lock(mutex_);
        return use(devices_.at(path));
    }

    std::vector<HidDeviceInfo> list() override {
        const std::lock_guard lock(mutex_);
        std::vector<HidDeviceInfo> infos;
        for (const auto& [path, device] : devices_) infos.push_back(device.info);
        return infos;
    }

    std::unique_ptr<HidConnection> open(const std::string& path) override {
        const std::lock_guard lock(mutex_);
        const auto found = devices_.find(path);
        if (found == devices_.end()) throw HidOpenError(path + ": cannot open it", false);
        if (!found->second.is_permitted) throw HidOpenError(path + ": no permission", true);
        return std::make_unique<Connection>(*this, path, generation_);
    }

  private:
    class Connection final : public HidConnection {
      public:
        Connection(FakeHid& hid, std::string path, int generation)
            : hid_(hid), path_(std::move(path)), generation_(generation) {}

        int read(std::span<std::uint8_t> into, int wait_ms) noexcept override {
            const int bytes = take(into);
            if (bytes != 0 || wait_ms == 0) return bytes;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            return take(into);
        }
        bool write(std::span<const std::uint8_t> report) noexcept override {
            const std::lock_guard lock(hid_.mutex_);
            if (hid_.generation_ != generation_) return false;
            FakeHidDevice& device = hid_.devices_.at(path_);
            device.from_host.emplace_back(report.begin(), report.end());
            device.on_report(device, device.from_host.back());
            return true;
        }

      private:
        int take(std::span<std::uint8_t> into) noexcept {
            const std::lock_guard lock(hid_.mutex_);
            if (hid_.generation_ != generation_) return gone;
            std::deque<Report>& waiting = hid_.devices_.at(path_).to_host;
            if (waiting.empty()) return 0;
            const std::size_t bytes = std::min(into.size(), waiting.front().size());
            std::copy_n(waiting.front().begin(), bytes, into.begin());
            waiting.pop_front();
            return static_cast<int>(bytes);
        }

        FakeHid& hid_;
        std::string path_;
        int generation_;
    };

    std::mutex mutex_;
    std::map<std::string, FakeHidDevice> devices_;
    int generation_ = 0;  // changes with every plug and unplug: a connection outlives neither
};

}  // namespace osteomill::testing
