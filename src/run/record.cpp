#include "run/record.hpp"

#include <fmt/chrono.h>
#include <sys/utsname.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/hash.hpp"
#include "run/flow.hpp"
#include "run/version.hpp"

namespace chute::run {

std::string RunRecord::now() { return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr))); }

void write_record(const std::filesystem::path& file, const RunRecord& r,
                  const std::optional<measure::Flow>& flow, std::span<const measure::Flow> starts) {
  utsname machine{};
  uname(&machine);
  nlohmann::ordered_json json{{"program", "chute"},
                              {"version", version},
                              {"commit", commit},
                              {"build", build_hash()},
                              {"command", r.command},
                              {"seed", r.seed},
                              {"threads", r.threads},
                              {"machine", fmt::format("{} {}", machine.sysname, machine.machine)},
                              {"started", r.started},
                              {"written", RunRecord::now()},
                              {"seconds", r.seconds},
                              {"steps", r.steps},
                              {"time_step", r.time_step},
                              {"time", r.time},
                              {"duration", r.duration},
                              {"clock", r.clock},
                              {"end", r.end}};
  if (r.left > 0) json["seconds_left"] = r.left;
  if (!r.why.empty()) json["why"] = r.why;
  if (flow) json["flow"] = to_json(*flow);
  if (r.account)
    json["energy"] = {
        {"residual", r.account->residual}, {"part", r.account->part}, {"verdict", r.account->word}};
  if (r.tilting) {
    const auto degrees = [](const std::optional<double>& angle) {
      return angle ? nlohmann::ordered_json(*angle) : nlohmann::ordered_json();
    };
    json["tilting"] = {{"start_angle", degrees(r.tilting->start)}, {"stop_angle", degrees(r.tilting->stop)}};
  }
  if (starts.size() > 1)
    for (const auto& start : starts) json["starts"].push_back(to_json(start));
  for (const auto& [name, sum] : r.files)
    json["files"][name] = {{"bytes", sum.bytes}, {"sha256", sum.sha256}};
  // a command line may hold any bytes
  write_atomically(file, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::string read_record_text(const std::filesystem::path& directory) {
  auto text = read_file(directory / "run.json");
  auto json = nlohmann::ordered_json::parse(text, nullptr, false);
  if (!json.is_object()) return text;
  json.erase("files");
  return json.dump(2) + "\n";
}

io::FileSums read_file_sums(const std::filesystem::path& directory) {
  const auto file = directory / "run.json";
  try {
    io::FileSums sums;
    const auto json = nlohmann::json::parse(read_file(file));
    for (const auto& [name, sum] : json.at("files").items())
      sums[name] = {sum.at("bytes").get<std::uint64_t>(), sum.at("sha256").get<std::string>(), false};
    return sums;
  } catch (const nlohmann::json::exception&) {
    throw InputError(file.string() + ": does not tell what the run's files hold");
  }
}

}  // namespace chute::run
