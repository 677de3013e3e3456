#include "devices/hid/hid_transport.h"

#include <fmt/format.h>
#include <hidapi.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace osteomill {

namespace {

struct CloseDevice {
    void operator()(hid_device* device) const { hid_close(device); }
};
using Device = std::unique_ptr<hid_device, CloseDevice>;

struct FreeList {
    void operator()(hid_device_info* list) const { hid_free_enumeration(list); }
};

/// Product names are for people to read: characters that are not plain text become question marks.
std::string plain_text(const wchar_t* text) {
    std::string plain;
    for (; text != nullptr && *text != L'\0'; ++text)
        plain += *text >= L' ' && *text <= L'~' ? static_cast<char>(*text) : '?';
    return plain;
}

class HidapiConnection final : public HidConnection {
  public:
    explicit HidapiConnection(Device device) : device_(std::move(device)) {}

    int read(std::span<std::uint8_t> into, int wait_ms) noexcept override {
        errno = 0;
        const int bytes = hid_read_timeout(device_.get(), into.data(), into.size(), wait_ms);
        if (bytes < 0) return errno == EINTR ? 0 : gone;
        return bytes;
    }

    bool write(std::span<const std::uint8_t> report) noexcept override {
        return hid_write(device_.get(), report.data(), report.size()) >= 0;
    }

  private:
    Device device_;
};

}  // namespace

std::vector<HidDeviceInfo> HidapiTransport::list() {
    const std::unique_ptr<hid_device_info, FreeList> list(hid_enumerate(0, 0));
    std::vector<HidDeviceInfo> found;
    for (const hid_device_info* entry = list.get(); entry != nullptr; entry = entry->next) {
        found.push_back({.path = entry->path,
                         .vendor_id = entry->vendor_id,
                         .product_id = entry->product_id,
                         .usage_page = entry->usage_page,
                         .usage = entry->usage,
                         .product = plain_text(entry->product_string)});
    }
    return found;
}

std::unique_ptr<HidConnection> HidapiTransport::open(const std::string& path) {
    if (Device device{hid_open_path(path.c_str())})
        return std::make_unique<HidapiConnection>(std::move(device));
    errno = 0;
    if (access(path.c_str(), R_OK | W_OK) != 0 && (errno == EACCES || errno == EPERM)) {
        throw HidOpenError(
            fmt::format("{}: no permission to use it; install {} (its first lines say how)", path, udev_rule),
            true);
    }
    throw HidOpenError(fmt::format("{}: cannot open it{}{}", path, errno != 0 ? ": " : "",
                                   errno != 0 ? std::strerror(errno) : ""),
                       false);
}

}  // namespace osteomill
