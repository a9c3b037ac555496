#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/film.hpp"

namespace chute::report {

struct ReportJob {
  std::vector<std::string> runs;  ///< run directories
  std::filesystem::path output;   ///< the page
  bool films = true;              ///< false: only what stands in tables
  FilmOptions film;
  std::string made_by;  ///< program and version, for the last line of the page
};

/// Writes one HTML page about the runs that needs nothing else: no file beside it and no network. The same bytes of the same
/// runs. InputError if a folder is no run, or is damaged; no half-written file is left.
void write_report(const ReportJob& job);

}  // namespace chute::report
