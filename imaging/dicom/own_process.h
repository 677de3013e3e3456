// A library's step in a process of its own: if a file makes the library crash, that process alone ends.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <span>

namespace osteomill {

/// Memory that a child shares with its parent, of zeros at first. Throws std::system_error where there is
/// none.
class SharedBytes {
  public:
    explicit SharedBytes(std::size_t size);
    ~SharedBytes();
    SharedBytes(const SharedBytes&) = delete;
    SharedBytes& operator=(const SharedBytes&) = delete;

    std::span<char> bytes() const { return bytes_; }

  private:
    std::span<char> bytes_;
};

/// Runs `step` quietly in a child (fork) and waits for it: true if it returned true; false if it returned
/// false, threw, or ended its process (an assertion, a signal). A child that does not compute
/// for `stuck_after` is ended, and the step tried once more: another thread may have held a lock at the fork,
/// which nobody opens in the child. Its only results are in SharedBytes made before. Throws std::system_error
/// if no process can be begun.
bool succeeds_apart(const std::function<bool()>& step,
                    std::chrono::seconds stuck_after = std::chrono::seconds(20));

}  // namespace osteomill
