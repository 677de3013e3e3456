#include "devices/hid/hid_worker.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace osteomill {

namespace {

/// A device that talks without end must not keep the loops off their processor. One on full-speed USB takes
/// twice as long for a report, and is not kept waiting.
constexpr std::chrono::microseconds shortest_exchange{500};

}  // namespace

std::unique_ptr<HidConversation> HidWorker::open() {
    const std::vector<HidDeviceInfo> devices = parts_.transport.list();
    const auto found = std::find_if(devices.begin(), devices.end(), parts_.is_wanted);
    if (found == devices.end()) {
        throw std::runtime_error(fmt::format(
            "there is no {}: is it plugged in and powered? --list-devices shows what is there", parts_.what));
    }
    return parts_.begin(parts_.transport.open(found->path));
}

void HidWorker::start() {
    conversation_ = open();
    stops_.store(false);
    thread_ = std::thread([this] {
        parts_.on_thread_start();
        run();
    });
}

void HidWorker::stop() noexcept {
    stops_.store(true);
    if (thread_.joinable()) thread_.join();
    conversation_.reset();
}

void HidWorker::run() {
    while (!stops_.load(std::memory_order_relaxed)) {
        if (conversation_ == nullptr) {
            look_again();
            continue;
        }
        const auto began = std::chrono::steady_clock::now();
        const bool goes_on = conversation_->exchange();
        std::this_thread::sleep_until(began + shortest_exchange);
        notice_.store(conversation_->notice(), std::memory_order_relaxed);
        if (goes_on) continue;
        conversation_.reset();
        notice_.store("the device is unplugged, or switched off: plug it in again",
                      std::memory_order_relaxed);
    }
}

void HidWorker::look_again() {
    try {
        conversation_ = open();
        return;
    } catch (const HidOpenError& error) {
        if (error.needs_permission()) {
            notice_.store(
                "no permission to use the device that was plugged in: install "
                "scripts/udev/70-osteomill.rules",
                std::memory_order_relaxed);
        }
    } catch (const std::exception&) {
        // Still unplugged, which the notice says.
    }
    constexpr int nap_ms = 10;  // so that stop() is not kept waiting
    for (int waited_ms = 0; waited_ms < look_again_ms && !stops_.load(std::memory_order_relaxed);
         waited_ms += nap_ms)
        std::this_thread::sleep_for(std::chrono::milliseconds(nap_ms));
}

}  // namespace osteomill
