// An OpenGL context that shares its textures with another one and is for a second thread.
#pragma once

namespace osteomill::gl {

class SecondContext {
  public:
    virtual ~SecondContext() = default;
    virtual void make_current() = 0;  ///< on the calling thread
    virtual void release() = 0;
};

}  // namespace osteomill::gl
