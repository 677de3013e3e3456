// Writer of text to a file, a pipe or a terminal, on a thread of its own, for threads that must not wait for
// it.
//
// What waits to be written is bounded. A descriptor that fails is given up for good: what comes later is
// forgotten. One that blocks (a terminal that Ctrl-S stopped, a pipe that nobody reads, a disk that does not
// answer) stops that thread alone. A thread blocked in write(2) cannot be joined: after a bounded wait it is
// left behind, and touches nothing but what it owns until it ends with the program.
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>

namespace osteomill {

class BackgroundWriter {
  public:
    /// How long finish() waits for a descriptor that takes nothing at the moment.
    static constexpr std::chrono::milliseconds longest_block{200};
    /// And for one that would take something, says the system, but does not: a machine so busy that the
    /// thread does not get its turn, or a disk.
    static constexpr std::chrono::milliseconds longest_standstill{2000};

    /// Writes to a duplicate of `descriptor`, so that it is the caller's to close or to redirect. One that is
    /// closed counts as one that fails.
    BackgroundWriter(int descriptor, std::size_t capacity_bytes);
    /// Finishes first, if need be.
    ~BackgroundWriter();
    BackgroundWriter(const BackgroundWriter&) = delete;
    BackgroundWriter& operator=(const BackgroundWriter&) = delete;

    // Any thread.

    /// False where less than the capacity is free: then the text is not taken. One that is longer is taken
    /// where nothing else waits. Never waits for the descriptor.
    bool push(std::string text);
    /// Whether nothing waits.
    bool is_idle() const;
    /// Waits, for as long as it takes, until nothing waits: for who may wait for a disk.
    void wait_until_idle() const;
    /// Why a write failed (errno); 0 while none has.
    int error() const;
    /// Takes nothing more and waits until all is written or given up, bounded as above. False where something
    /// was left behind that a block or a standstill kept from being written.
    bool finish();

  private:
    struct Shared;
    static void run(const std::shared_ptr<Shared>& shared);

    std::shared_ptr<Shared> shared_;
};

}  // namespace osteomill
