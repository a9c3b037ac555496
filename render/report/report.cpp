#include "report/report.hpp"

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "report/page.hpp"

namespace chute::report {

void write_report(const ReportJob& job) {
  Contents contents;
  contents.runs = read_runs(job.runs);
  if (job.films) contents.films = make_films(contents.runs, job.film);
  contents.gallery = make_gallery(contents.runs);
  contents.made_by = job.made_by;
  const auto page = page_of(contents);
  std::error_code error;
  if (job.output.has_parent_path()) std::filesystem::create_directories(job.output.parent_path(), error);
  write_atomically(job.output, page);
}

}  // namespace chute::report
