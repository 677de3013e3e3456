#include "render_client/volume/gl/storage_thread.h"

#include <utility>

namespace osteomill::gl {

StorageThread::StorageThread(std::unique_ptr<SecondContext> context) : context_(std::move(context)) {
    thread_ = std::thread([this] { run(); });
}

StorageThread::~StorageThread() {
    {
        const std::scoped_lock lock(mutex_);
        is_over_ = true;
    }
    has_news_.notify_one();
    thread_.join();
}

std::future<Texture3D> StorageThread::make(VoxelFormat format, const glm::ivec3& size) {
    const auto promise = std::make_shared<std::promise<Texture3D>>();
    std::future<Texture3D> made = promise->get_future();
    post([promise, format, size] {
        try {
            Texture3D texture(format, size);
            // The other context must not see a texture half made.
            glFinish();
            promise->set_value(std::move(texture));
        } catch (...) {
            promise->set_exception(std::current_exception());
        }
    });
    return made;
}

void StorageThread::discard(std::shared_ptr<void> unused) {
    post([unused = std::move(unused)]() mutable { unused.reset(); });
}

void StorageThread::post(std::function<void()> job) {
    {
        const std::scoped_lock lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    has_news_.notify_one();
}

void StorageThread::run() {
    context_->make_current();
    while (true) {
        std::function<void()> job;
        {
            std::unique_lock lock(mutex_);
            has_news_.wait(lock, [this] { return is_over_ || !jobs_.empty(); });
            if (jobs_.empty()) break;
            job = std::move(jobs_.front());
            jobs_.pop_front();
        }
        job();
    }
    context_->release();
}

std::future<Texture3D> make_texture(StorageThread* thread, VoxelFormat format, const glm::ivec3& size) {
    if (thread != nullptr) return thread->make(format, size);
    std::promise<Texture3D> made;
    made.set_value(Texture3D(format, size));
    return made.get_future();
}

}  // namespace osteomill::gl
