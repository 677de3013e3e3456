// An atomic value that a copy of its owner takes along, as it is at the moment.
#pragma once

#include <atomic>

namespace osteomill {

/// Copied only while nobody writes to it.
template <typename Value>
class CopiableAtomic : public std::atomic<Value> {
  public:
    using std::atomic<Value>::atomic;
    using std::atomic<Value>::operator=;
    CopiableAtomic() = default;
    CopiableAtomic(const CopiableAtomic& other) : std::atomic<Value>(other.load(std::memory_order_relaxed)) {}
    CopiableAtomic& operator=(const CopiableAtomic& other) {
        this->store(other.load(std::memory_order_relaxed), std::memory_order_relaxed);
        return *this;
    }
};

}  // namespace osteomill
