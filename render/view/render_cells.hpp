#pragma once
#include <vector>

#include "read/run_frames.hpp"
#include "view/render_run.hpp"

namespace chute::view {

/// Do these frames hold fields on grids (.vti, .pvti) instead of grains?
bool are_cells(const std::vector<read::FrameFile>& frames);

/// Draws fields of cells as maps with axes and a colour bar, one colour range and one extent for all frames. `style.color` names
/// the field, as `velocity:x`; by default density, or the first. In space it is the mean over the direction across.
RenderReport render_cells(const RenderJob& job, const std::vector<read::FrameFile>& frames,
                          const std::vector<std::size_t>& numbers);

}  // namespace chute::view
