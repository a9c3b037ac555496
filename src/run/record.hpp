#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "io/run_files.hpp"
#include "measure/account.hpp"
#include "measure/steadiness.hpp"
#include "measure/tilting.hpp"

namespace chute::run {

/// run.json: what made a run directory, and how it ended.
struct RunRecord {
  std::string command;
  std::int64_t seed = 0;
  int threads = 1;
  std::string started = now();
  double seconds = 0;
  std::int64_t steps = 0;
  double time_step = 0, time = 0, duration = 0;
  double left = 0;             ///< seconds that it will still take, about, while it is running; 0: not known
  std::string clock = "time";  ///< what `time` counts
  std::optional<measure::TurningAngles> tilting{};   ///< of an incline that is tilted meanwhile
  std::string end = "running", why{};                ///< `why` is left out if empty
  std::optional<measure::AccountVerdict> account{};  ///< of the energy
  io::FileSums files{};                              ///< what each file that was written holds

  /// This moment in universal time, 2026-01-31T12:00:00Z.
  static std::string now();
};

/// Writes it, with what became of the flow if that is known, and of each of several independent starts.
void write_record(const std::filesystem::path& file, const RunRecord& record,
                  const std::optional<measure::Flow>& flow = {}, std::span<const measure::Flow> starts = {});

/// run.json for people to read: without what each file holds. The text as it is if it is damaged.
std::string read_record_text(const std::filesystem::path& directory);
/// The files that the run.json of a folder tells of. InputError if it cannot be read.
io::FileSums read_file_sums(const std::filesystem::path& directory);

}  // namespace chute::run
