#include "manifest.hpp"

#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"

namespace chute::golden {

std::map<std::string, Record> read_manifest(const std::filesystem::path& path) {
  std::map<std::string, Record> records;
  if (!std::filesystem::exists(path)) return records;
  try {
    const auto all = nlohmann::json::parse(read_file(path));
    for (const auto& [name, entry] : all.items()) {
      Record r;
      r.made_by = entry.at("made_by"), r.versions = entry.at("versions"), r.reason = entry.at("reason");
      r.sha256 = entry.at("sha256");
      const auto& t = entry.at("tolerance");
      r.tolerance = {t.at("channel"), t.at("share"), t.at("limit")};
      records.emplace(name, r);
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path.string() + ": " + error.what());
  }
  return records;
}

void write_manifest(const std::filesystem::path& path, const std::map<std::string, Record>& records) {
  nlohmann::ordered_json all;
  for (const auto& [name, r] : records)
    all[name] = {
        {"made_by", r.made_by},
        {"versions", r.versions},
        {"reason", r.reason},
        {"sha256", r.sha256},
        {"tolerance",
         {{"channel", r.tolerance.channel}, {"share", r.tolerance.share}, {"limit", r.tolerance.limit}}}};
  write_atomically(path, all.dump(2) + "\n");
}

}  // namespace chute::golden
