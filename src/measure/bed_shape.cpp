#include "beds/tessellation.hpp"
#include "common/error.hpp"
#include "measure/ball_outputs.hpp"

namespace chute::measure {
namespace {

/// The gaps of a plane of beads, thesis fig. 4.23: Δx = |r_i − r_j| − 2r of neighbours, and Δx = |r_i − r_V| − r of a bead
/// and the vertices of its Voronoi cell.
class BedShape final : public Remembering<BedShape> {
 public:
  explicit BedShape(const RunContext& run) : run_(run) {}
  std::int64_t next_after(std::int64_t) const override { return std::numeric_limits<std::int64_t>::max(); }
  void look(const Look& look) override {
    if (!neighbours_.empty()) return;
    const auto grains = look.engine.grains();
    beds::Sheet sheet{grains.period[0], grains.period[1], {}};
    for (std::size_t i = grains.moving; i < grains.size(); ++i)
      sheet.place.push_back(sheet.wrapped({grains.position[0][i], grains.position[1][i]}));
    const auto t = beds::tessellate(sheet);
    const double r = grains.radius[grains.moving];
    for (const auto& edge : t.edges) neighbours_.push_back(edge.distance - 2 * r);
    for (const auto& vertex : t.vertices) vertices_.push_back(vertex.distance - r);
  }
  void write(const Flow&) const override {
    const auto table = [&](const char* name, const char* what, const std::vector<double>& values) {
      io::Csv csv(run_.comments(what), {"delta_x"});
      for (const double v : values) csv.row({v});
      run_.write(name, csv.text());
    };
    table("bed_neighbours.csv", "distances of neighbouring beads (Delaunay) minus 2r", neighbours_);
    table("bed_vertices.csv", "distances of Voronoi vertices from their beads minus r", vertices_);
  }
  template <class Archive>
  void serialize(Archive& a) {
    a(neighbours_, vertices_);
  }

 private:
  const RunContext& run_;
  std::vector<double> neighbours_, vertices_;
};

}  // namespace

std::vector<std::unique_ptr<Observer>> BedOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<BedShape>(run));
  return observers;
}

}  // namespace chute::measure
