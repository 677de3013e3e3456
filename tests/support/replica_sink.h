// Changes of a carve, taken over by a replica of the bone.
#pragma once

#include <gtest/gtest.h>

#include "common/bone/brick_change.h"
#include "common/wire/bone_replica.h"

namespace osteomill::testing {

class ReplicaSink final : public ChangeSink {
  public:
    explicit ReplicaSink(BoneReplica& replica) : replica_(replica) {}
    void push(const BrickChange& change, BrickFractions fractions) noexcept override {
        EXPECT_TRUE(replica_.apply(change, fractions));
    }

  private:
    BoneReplica& replica_;
};

}  // namespace osteomill::testing
