#include "sweep/sweep_file.hpp"

#include "common/error.hpp"
#include "common/toml_reader.hpp"

namespace chute::sweep {
namespace {

/// What of the whole file belongs to the sweep.
struct Section {
  SweepSpec& spec;
};
template <class Archive>
void describe(Archive& a, Section& section) {
  a.required_section("sweep", section.spec);
}

}  // namespace

static toml::table read_table(const Base& base) {
  auto table = parse_toml(base.text, base.file.string());
  for (const auto& setting : base.set) set_by_path(table, setting);
  return table;
}

bool is_sweep(const Base& base) { return read_table(base).contains("sweep"); }

SweepSpec read_sweep(const Base& base) {
  const auto table = read_table(base);
  if (!table.contains("sweep"))
    throw InputError(base.file.string() +
                     ": has no [sweep], which says what to change; a single run is: chute run");
  TomlReader reader(table, base.file.string());
  SweepSpec spec;
  Section section{spec};
  describe(reader, section);  // the scene's own keys are read, and checked, by the scene
  return spec;
}

std::string to_toml(const Base& base, SweepSpec spec) {
  TomlWriter writer;
  Section section{spec};
  describe(writer, section);
  return scene::to_toml(base.scene(grid(spec.axes).front().set)) + writer.text();
}

}  // namespace chute::sweep
