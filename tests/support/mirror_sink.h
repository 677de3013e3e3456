// Edits of a carve, taken over by a mirror of the bone.
#pragma once

#include <gtest/gtest.h>

#include "common/bone/edit.h"
#include "haptic_server/streaming/bone_mirror.h"

namespace osteomill::testing {

class MirrorSink final : public EditSink {
  public:
    explicit MirrorSink(BoneMirror& mirror) : mirror_(mirror) {}
    void push(const EditRun& run) noexcept override { EXPECT_TRUE(mirror_.apply(run)); }

  private:
    BoneMirror& mirror_;
};

}  // namespace osteomill::testing
