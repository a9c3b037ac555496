#include "common/atomic_file.hpp"
#include "measure/fields.hpp"
#include "measure/profiles.hpp"
#include "run/observer.hpp"

namespace chute::run {
namespace {

/// Averages over layers, or coarse-grained over the height: `Measure` samples and gives rows.
template <class Measure, class Row>
class Layers final : public Remembering<Layers<Measure, Row>> {
 public:
  struct File {
    const char *name, *what;
    Columns<Row> columns;
  };
  Layers(const RunContext& run, File file, std::optional<double> from, double every, Measure measure)
      : run_(run),
        file_(std::move(file)),
        due_(run.schedule(from.value_or(0), every)),
        from_(from),
        measure_(std::move(measure)) {}

  std::int64_t next_after(std::int64_t step) const override { return due_.after(step); }
  void look(const Look& look) override {
    if (due_.index_at(look.engine.step()) >= 0) measure_.sample(look.engine.grains(), look.engine.contacts());
  }
  void write(const measure::Flow& flow) const override {
    write_atomically(
        run_.directory.file(file_.name),
        file_.columns.csv(run_.comments(file_.what), measure_.result(from_.value_or(flow.from))));
  }
  template <class Archive>
  void serialize(Archive& archive) {
    archive(measure_);
  }

 private:
  const RunContext& run_;
  File file_;
  Schedule due_;
  std::optional<double> from_;
  Measure measure_;
};

using measure::FieldPoint;
using measure::ProfileBin;
using ProfileLayers = Layers<measure::Profiles, ProfileBin>;
using FieldLayers = Layers<measure::Fields, FieldPoint>;

/// The stresses are the last but for one column of either table.
template <class Row>
Columns<Row>& add_stresses(Columns<Row>& columns) {
  return columns.add("kinetic_xx", &Row::kinetic_xx)
      .add("kinetic_xy", &Row::kinetic_xy)
      .add("kinetic_yy", &Row::kinetic_yy)
      .add("contact_xx", &Row::contact_xx)
      .add("contact_xy", &Row::contact_xy)
      .add("contact_yy", &Row::contact_yy);
}

Columns<ProfileBin> profile_columns() {
  Columns<ProfileBin> columns;
  columns.add("h", &ProfileBin::h)
      .add("grains", &ProfileBin::grains)
      .add("eta", &ProfileBin::eta)
      .add("eta_exact", &ProfileBin::eta_exact)
      .add("v_x", &ProfileBin::v_x)
      .add("v_y", &ProfileBin::v_y)
      .add("sigma_x", &ProfileBin::sigma_x)
      .add("sigma_y", &ProfileBin::sigma_y)
      .add("omega", &ProfileBin::omega)
      .add("half_shear", &ProfileBin::half_shear);
  return add_stresses(columns).add("coordination", &ProfileBin::coordination);
}

Columns<FieldPoint> field_columns() {
  Columns<FieldPoint> columns;
  columns.add("h", &FieldPoint::h)
      .add("density", &FieldPoint::density)
      .add("v_x", &FieldPoint::v_x)
      .add("v_y", &FieldPoint::v_y);
  return add_stresses(columns);
}

}  // namespace

std::vector<std::unique_ptr<Observer>> observe_profiles(const RunContext& run) {
  std::vector<std::unique_ptr<Observer>> files;
  const auto& spec = run.scene.output.profiles;
  const auto add = [&](const char* name, double bin) {
    const ProfileLayers::File file{
        name,
        "time averages over layers at height h above the centres of the bed; errors from "
        "blocks of the time window",
        profile_columns()};
    files.push_back(std::make_unique<ProfileLayers>(
        run, file, spec->from, *spec->every, measure::Profiles(run.length, bin, run.window(spec->from))));
  };
  if (spec) add("profiles.csv", spec->bin);
  if (spec && spec->fine) add("profiles_fine.csv", *spec->fine);
  return files;
}

std::unique_ptr<Observer> observe_fields(const RunContext& run) {
  const auto& spec = run.scene.output.fields;
  if (!spec) return nullptr;
  const FieldLayers::File file{
      "fields.csv",
      "fields coarse-grained over the height h above the centres of the bed (Goldhirsch "
      "2010), averaged along the line and in time; errors from blocks of the time window",
      field_columns()};
  return std::make_unique<FieldLayers>(run, file, spec->from, *spec->every,
                                       measure::Fields(run.length, spec->width, run.window(spec->from)));
}

}  // namespace chute::run
