#include "render_client/ui/panels/tool_history.h"

namespace osteomill {

void ToolHistory::add(const ToolState& tool) {
    if (!samples_.empty() && tool.time_s < samples_.back().time_s) samples_.clear();
    if (!samples_.empty() && tool.time_s == samples_.back().time_s) return;
    samples_.push_back({tool.time_s, tool.force_n, tool.depth_mm, tool.removed_mm3});
    while (samples_.front().time_s < tool.time_s - kept_s) samples_.pop_front();
}

}  // namespace osteomill
