// A run that turns a recording into an image set: for chosen frames and cameras the picture, depth, labels
// and normals, and an index with the poses of all (dataset_index.h).
//
// Nothing depends on the time that it takes: the same command writes the same bytes on one machine.
#pragma once

#include <functional>
#include <string>

#include "render_client/ui/options.h"
#include "render_client/ui/run_json.h"

namespace osteomill {

/// Draws the dataset of options.replay as options.dataset says; the index gets the program's `version`. Files
/// that are there already under the same names are replaced. Ends early, with the index of the written
/// frames, when `stop_requested` says so. Throws std::runtime_error, in one line, if something cannot be
/// read, drawn or written, SceneError for the cameras, and gl::NoOpenGl.
RenderReport run_dataset(const RenderOptions& options, const std::string& version,
                         const std::function<bool()>& stop_requested);

}  // namespace osteomill
