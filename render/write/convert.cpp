#include "write/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "read/run_frames.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 4> endings{"dump", "xyz", "csv", "vtp"};

void refuse_folder_in_use(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder.string() + ": is a file; name a folder for the frames");
  if (fs::is_directory(folder, error) && !fs::is_empty(folder, error))
    throw InputError(folder.string() +
                     ": is not empty; name a new folder, so that no other frames stand among these");
}

bool is_tilted(const read::GrainFrame& frame) {
  if (!frame.lattice) return false;
  for (int edge = 0; edge < 3; ++edge)
    if (frame.lattice->axis_of(edge) < 0) return true;
  return false;
}

class Conversion {
 public:
  explicit Conversion(const ConvertJob& job) : job_(job) {}

  ConvertReport go() {
    if (job_.one_file && job_.format == Format::vtp)
      throw InputError("--one-file: a VTK file holds one time; leave it out, or take another format");
    refuse_folder_in_use(job_.folder);
    std::vector<read::FrameFile> frames;
    for (const auto& source : job_.sources)
      for (auto& frame : read::find_frames(source)) frames.push_back(std::move(frame));
    // A shell gives dump.10 before dump.2.
    if (std::ranges::all_of(frames, [](const auto& frame) { return frame.time.has_value(); }))
      std::ranges::stable_sort(frames, {}, [](const auto& frame) { return *frame.time; });
    for (const auto& frame : frames) {
      add(frame);
      if (job_.progress && !job_.progress(report_.frames, frames.size()))
        throw WorkError(fmt::format("stopped; {} of {} frames are in {}", report_.frames, frames.size(),
                                    job_.folder.string()));
    }
    finish();
    return report_;
  }

 private:
  const ConvertJob& job_;
  ConvertReport report_;
  std::optional<Temporary> whole_;
  std::vector<std::pair<double, std::string>> times_;

  std::string_view ending() const { return endings[static_cast<std::size_t>(job_.format)]; }

  void add(const read::FrameFile& file) {
    const auto frame = read::parse_frame(read::read_files(file), job_.meanings);
    const FrameFacts facts{report_.frames, frame.time ? frame.time : file.time, job_.from_one};
    const auto bytes = bytes_of(frame, facts);
    if (report_.frames == 0) fs::create_directories(job_.folder);
    report_.left_out += frame.left_out;
    report_.tilted |= is_tilted(frame) && (job_.format == Format::vtp || job_.format == Format::csv);
    if (job_.one_file) {
      if (!whole_) whole_.emplace(job_.folder / fmt::format("frames.{}", ending()));
      whole_->write(bytes);
    } else if (job_.format == Format::vtp) {
      const auto name = fmt::format("frames/{:06}.vtp", report_.frames);
      fs::create_directories(job_.folder / "frames");
      write_atomically(job_.folder / name, bytes, Flush::later);
      times_.emplace_back(facts.time.value_or(static_cast<double>(facts.number)), name);
    } else {
      write_atomically(job_.folder / fmt::format("{:06}.{}", report_.frames, ending()), bytes, Flush::later);
    }
    ++report_.frames;
  }

  std::string bytes_of(const read::GrainFrame& frame, const FrameFacts& facts) const {
    switch (job_.format) {
      case Format::lammps_dump:
        return lammps_dump(frame, facts);
      case Format::xyz:
        return xyz_frame(frame, facts);
      case Format::csv:
        return job_.one_file ? csv_rows(frame, facts, report_.frames == 0) : csv_frame(frame, facts);
      case Format::vtp:
        break;
    }
    return vtp_frame(frame, facts);
  }

  void finish() {
    if (whole_) {
      whole_->flush();
      whole_->move_into_place();
    }
    if (job_.format == Format::vtp) write_atomically(job_.folder / "frames.pvd", time_index(times_));
  }
};

}  // namespace

ConvertReport convert(const ConvertJob& job) { return Conversion(job).go(); }

}  // namespace chute::write
