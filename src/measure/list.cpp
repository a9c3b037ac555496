#include "measure/avalanches.hpp"
#include "measure/ball_outputs.hpp"
#include "measure/cells.hpp"
#include "measure/flow_outputs.hpp"
#include "measure/force_distribution.hpp"
#include "measure/moments.hpp"
#include "measure/outputs.hpp"
#include "measure/pair_distances.hpp"

namespace chute::measure {

Catalogue<Output>& list() {
  static Catalogue<Output> all{
      kind_of<Output, FramesOutput>(),     kind_of<Output, SeriesOutput>(),
      kind_of<Output, ProfilesOutput>(),   kind_of<Output, FieldsOutput>(),
      kind_of<Output, ImpactsOutput>(),    kind_of<Output, ImpactHistogramsOutput>(),
      kind_of<Output, PairsOutput>(),      kind_of<Output, VelocitiesOutput>(),
      kind_of<Output, DiffusionOutput>(),  kind_of<Output, BeadsOutput>(),
      kind_of<Output, TrappingOutput>(),   kind_of<Output, BedOutput>(),
      kind_of<Output, AvalanchesOutput>(), kind_of<Output, CellsOutput>(),
      kind_of<Output, ForcesOutput>(),     kind_of<Output, MomentsOutput>(),
      kind_of<Output, StartingOutput>(),   kind_of<Output, HeightsOutput>(),
      kind_of<Output, AcrossOutput>(),     kind_of<Output, HistoryOutput>(),
      kind_of<Output, DischargeOutput>(),  kind_of<Output, SegregationOutput>(),
      kind_of<Output, SurfaceOutput>(),
  };
  return all;
}

std::vector<std::string> all_files() {
  std::vector<std::string> names;
  for (const auto& kind : list())
    for (const auto& name : kind.make()->files()) names.push_back(name);
  return names;
}

}  // namespace chute::measure
