#include "common/log/text_writer.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace osteomill {

namespace {

/// So much at a time, that progress shows.
constexpr std::size_t most_at_once_bytes = 65'536;

class Descriptor final : public BackgroundWriter<std::string>::Sink {
  public:
    explicit Descriptor(int descriptor) : descriptor_(::fcntl(descriptor, F_DUPFD_CLOEXEC, 3)) {
        if (descriptor_ < 0) defect = std::strerror(errno);
    }
    ~Descriptor() override {
        if (descriptor_ >= 0) ::close(descriptor_);
    }

    void write(const std::string& text) override {
        for (std::size_t begin = 0; begin < text.size();) {
            const ssize_t count =
                ::write(descriptor_, text.data() + begin, std::min(text.size() - begin, most_at_once_bytes));
            if (count >= 0) {
                begin += static_cast<std::size_t>(count);
                ++progress;
            } else if (errno == EAGAIN) {  // somebody else made it one that does not wait
                can_be_written_to(-1);
            } else if (errno != EINTR) {
                throw std::system_error(errno, std::generic_category());
            }
        }
    }
    bool is_ready() const override { return can_be_written_to(0); }

  private:
    bool can_be_written_to(int wait_ms) const {
        pollfd watched{.fd = descriptor_, .events = POLLOUT, .revents = 0};
        return ::poll(&watched, 1, wait_ms) > 0;
    }

    const int descriptor_;
};

}  // namespace

TextWriter::TextWriter(int descriptor, std::size_t capacity_bytes)
    : BackgroundWriter(std::make_shared<Descriptor>(descriptor), capacity_bytes) {}

}  // namespace osteomill
