// A bone as Python sees it: of a case, of a session at work, or of a recording at an instant.
#pragma once

#include <memory>
#include <utility>

#include "common/bone/bone.h"
#include "python/module/loaded_case.h"
#include "python/module/stepped_session.h"

namespace osteomill::python {

class PythonBone {
  public:
    /// The bone as it was loaded.
    explicit PythonBone(std::shared_ptr<const LoadedCase> loaded) : loaded_(std::move(loaded)) {}
    /// The session's bone at each moment of reading.
    explicit PythonBone(std::shared_ptr<SteppedSession> session)
        : loaded_(session->shared_case()), session_(std::move(session)) {}
    /// A bone of its own, without CT numbers.
    explicit PythonBone(Bone bone) : own_(std::make_shared<const Bone>(std::move(bone))) {}

    const Bone& bone() const {
        if (own_) return *own_;
        return session_ ? session_->bone() : loaded_->scene().bone;
    }
    /// Null: there are no CT numbers.
    const BoneSource* source() const { return loaded_ ? &loaded_->scene().source : nullptr; }
    /// Null: the bone never changes.
    SteppedSession* session() const { return session_.get(); }

  private:
    std::shared_ptr<const LoadedCase> loaded_;
    std::shared_ptr<SteppedSession> session_;
    std::shared_ptr<const Bone> own_;
};

}  // namespace osteomill::python
