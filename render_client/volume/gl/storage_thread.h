// A thread on which the driver makes and frees the memory of large textures. A driver may clear it, page by
// page: Mesa's software one takes 0.6 s for 500 MB, in one call that cannot be divided, during which a window
// would not answer.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

#include "render_client/volume/gl/texture.h"

namespace osteomill::gl {

/// An OpenGL context that shares its textures with another one and is for a second thread.
class SecondContext {
  public:
    virtual ~SecondContext() = default;
    virtual void make_current() = 0;  ///< on the calling thread
    virtual void release() = 0;
};

class StorageThread {
  public:
    explicit StorageThread(std::unique_ptr<SecondContext> context);
    /// Ends the thread after all that was requested is done.
    ~StorageThread();
    StorageThread(const StorageThread&) = delete;
    StorageThread& operator=(const StorageThread&) = delete;

    /// A texture as Texture3D's constructor makes it; the future throws what that throws.
    std::future<Texture3D> make(VoxelFormat format, const glm::ivec3& size);
    /// Destroys something that may have textures of either context.
    void discard(std::shared_ptr<void> unused);

  private:
    void run();
    void post(std::function<void()> job);

    std::unique_ptr<SecondContext> context_;
    std::mutex mutex_;
    std::condition_variable has_news_;
    std::deque<std::function<void()>> jobs_;
    bool is_over_ = false;
    std::thread thread_;
};

/// A texture made by `thread`, or here and now if there is none.
std::future<Texture3D> make_texture(StorageThread* thread, VoxelFormat format, const glm::ivec3& size);

}  // namespace osteomill::gl
