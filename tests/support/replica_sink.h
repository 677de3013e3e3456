// Edits of a carve, taken over by a replica of the bone.
#pragma once

#include <gtest/gtest.h>

#include "common/bone/edit.h"
#include "common/wire/bone_replica.h"

namespace osteomill::testing {

class ReplicaSink final : public EditSink {
  public:
    explicit ReplicaSink(BoneReplica& replica) : replica_(replica) {}
    void push(const EditRun& run) noexcept override { EXPECT_TRUE(replica_.apply(run)); }

  private:
    BoneReplica& replica_;
};

}  // namespace osteomill::testing
