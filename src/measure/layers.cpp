#include <fmt/format.h>

#include "measure/contact_samples.hpp"
#include "measure/fields.hpp"
#include "measure/outputs.hpp"
#include "measure/profiles.hpp"

namespace chute::measure {
namespace {

/// Averages over layers, or coarse-grained over the height: `Measure` samples and gives rows.
template <class Measure, class Row>
class Layers final : public Remembering<Layers<Measure, Row>> {
 public:
  struct File {
    const char *name, *what;
    Columns<Row> columns;
  };
  Layers(const RunContext& run, File file, From from, double every, Measure measure)
      : run_(run),
        file_(std::move(file)),
        due_(run.schedule(from.value_or(0), every)),
        from_(from),
        contacts_(run, due_.step_of(0)),
        measure_(std::move(measure)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  bool wants_collisions(std::int64_t step) const override { return contacts_.wants_collisions(step); }
  void look(const Look& look) override {
    contacts_.gather(look);
    if (due_.index_at(look.engine.step()) < 0) return;
    const auto forces = contacts_.take(look);
    if (!forces) return;
    const bool hard = run_.offers.collisions;
    measure_.sample(look.engine.grains(), hard ? look.engine.contacts() : *forces, *forces);
  }
  void write(const Flow& flow) const override {
    auto comments = run_.comments(file_.what);
    for (auto& line : run_.average_note(from_, flow)) comments.push_back(std::move(line));
    if (measure_.beyond() > 0)
      comments.push_back(fmt::format("{} samples of grains higher than {} layers are left out",
                                     measure_.beyond(), most_layers));
    run_.write(file_.name, file_.columns.csv(comments, measure_.result(from_.value_or(flow.from))));
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(measure_, contacts_);
  }

 private:
  const RunContext& run_;
  File file_;
  Schedule due_;
  From from_;
  ContactSamples contacts_;
  Measure measure_;
};

using ProfileLayers = Layers<Profiles, ProfileBin>;
using FieldLayers = Layers<Fields, FieldPoint>;

/// A column for each component that exists.
template <class Row>
void add_vector(Columns<Row>& columns, int dimensions, const std::string& name,
                std::array<Estimate, 3> Row::*member) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(dimensions); ++k)
    columns.add_estimate(name + "_" + axis_names[k],
                         [member, k](const Row& row) -> const Estimate& { return (row.*member)[k]; });
}
template <class Row>
void add_tensor(Columns<Row>& columns, int dimensions, const std::string& name,
                std::array<Estimate, 6> Row::*member) {
  for (std::size_t t = 0; t < 6; ++t)
    if (exists_in(dimensions, t))
      columns.add_estimate(name + "_" + tensor_names[t],
                           [member, t](const Row& row) -> const Estimate& { return (row.*member)[t]; });
}

Columns<ProfileBin> profile_columns(int dimensions) {
  Columns<ProfileBin> columns;
  columns.add("h", &ProfileBin::h)
      .add("grains", &ProfileBin::grains)
      .add("eta", &ProfileBin::eta)
      .add("eta_exact", &ProfileBin::eta_exact);
  add_vector(columns, dimensions, "v", &ProfileBin::v);
  add_vector(columns, dimensions, "sigma", &ProfileBin::sigma);
  columns.add("temperature", &ProfileBin::temperature)
      .add("omega", &ProfileBin::omega)
      .add("half_shear", &ProfileBin::half_shear);
  add_tensor(columns, dimensions, "kinetic", &ProfileBin::kinetic);
  add_tensor(columns, dimensions, "contact", &ProfileBin::contact);
  return columns.add("coordination", &ProfileBin::coordination);
}

Columns<FieldPoint> field_columns(int dimensions) {
  Columns<FieldPoint> columns;
  columns.add("h", &FieldPoint::h).add("density", &FieldPoint::density);
  add_vector(columns, dimensions, "v", &FieldPoint::v);
  add_tensor(columns, dimensions, "kinetic", &FieldPoint::kinetic);
  add_tensor(columns, dimensions, "contact", &FieldPoint::contact);
  return columns;
}

/// What lengths and times between samples are if they are not given.
template <class Spec>
void fill_layers(std::optional<Spec>& spec, double Spec::*size, const Scales& scales) {
  if (!spec) return;
  if (*spec.*size == 0) *spec.*size = scales.length;
  if (!spec->every) spec->every = scales.between_samples;
}

}  // namespace

void ProfilesOutput::fill(const Scales& scales) { fill_layers(spec, &ProfileSpec::bin, scales); }

std::vector<std::unique_ptr<Observer>> ProfilesOutput::make(const RunContext& run) const {
  std::vector<std::unique_ptr<Observer>> observers;
  const auto add = [&](const char* name, double bin) {
    const ProfileLayers::File file{
        name,
        "time averages over layers at height h above the centres of the bed; errors from "
        "blocks of the time window",
        profile_columns(run.frame.dimensions)};
    observers.push_back(std::make_unique<ProfileLayers>(run, file, spec->from, *spec->every,
                                                        Profiles(run.frame, bin, run.window(spec->from))));
  };
  add("profiles.csv", spec->bin);
  if (spec->fine) add("profiles_fine.csv", *spec->fine);
  return observers;
}

void FieldsOutput::fill(const Scales& scales) { fill_layers(spec, &FieldSpec::width, scales); }

std::vector<std::unique_ptr<Observer>> FieldsOutput::make(const RunContext& run) const {
  const FieldLayers::File file{
      "fields.csv",
      "fields coarse-grained over the height h above the centres of the bed (Goldhirsch "
      "2010), averaged along the bed and in time; errors from blocks of the time window",
      field_columns(run.frame.dimensions)};
  std::vector<std::unique_ptr<Observer>> observers;
  observers.push_back(std::make_unique<FieldLayers>(run, file, spec->from, *spec->every,
                                                    Fields(run.frame, spec->width, run.window(spec->from))));
  return observers;
}

}  // namespace chute::measure
