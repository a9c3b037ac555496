#include "write/convert.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <sstream>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/in_child.hpp"
#include "common/new_folder.hpp"
#include "common/pvd.hpp"
#include "read/run_frames.hpp"
#include "write/frame_file.hpp"

namespace chute::write {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::string_view, 4> endings{"dump", "xyz", "csv", "vtp"};

bool is_tilted(const read::GrainFrame& frame) {
  if (!frame.lattice) return false;
  for (int edge = 0; edge < 3; ++edge)
    if (frame.lattice->axis_of(edge) < 0) return true;
  return false;
}

/// What is to be known of a frame that has been written.
struct Written {
  std::optional<double> time;
  std::size_t left_out = 0;
  bool tilted = false;
};

/// The same as text, for it comes from another process.
std::string text_of(const Written& w) {
  return fmt::format("{} {} {} {}", w.time.has_value() ? 1 : 0, w.time.value_or(0), w.left_out,
                     w.tilted ? 1 : 0);
}
Written written_from(const std::string& text) {
  std::istringstream in(text);
  int timed = 0, tilted = 0;
  std::string time;
  Written w;
  in >> timed >> time >> w.left_out >> tilted;
  if (timed) w.time = std::stod(time);
  w.tilted = tilted != 0;
  return w;
}

/// Is it a name of what a conversion writes: frames, frames.pvd, frames.csv, 000012.dump?
bool is_converted(const fs::path& name) {
  const auto stem = name.stem().string(), ending = name.extension().string();
  if (stem == "frames" && (ending.empty() || ending == ".pvd")) return true;
  const bool known = ending.size() > 1 && std::ranges::count(endings, std::string_view(ending).substr(1)) > 0;
  return known && (stem == "frames" ||
                   (stem.size() >= 6 && stem.find_first_not_of("0123456789") == std::string::npos));
}

class Conversion {
 public:
  explicit Conversion(const ConvertJob& job) : job_(job), folder_(job.folder, is_converted, beside) {}

  ConvertReport go() {
    if (job_.one_file && job_.format == Format::vtp)
      throw InputError("--one-file: a VTK file holds one time; leave it out, or take another format");
    for (const auto& source : job_.sources)
      for (auto& frame : read::find_frames(source)) frames_.push_back(std::move(frame));
    // A shell gives dump.10 before dump.2.
    if (std::ranges::all_of(frames_, [](const auto& frame) { return frame.time.has_value(); }))
      std::ranges::stable_sort(frames_, {}, [](const auto& frame) { return *frame.time; });
    written_.resize(frames_.size());
    written_[0] = add(0);
    told(1);
    if (job_.jobs > 1 && !job_.one_file)
      side_by_side();
    else
      for (std::size_t k = 1; k < frames_.size(); ++k) written_[k] = add(k), told(k + 1);
    finish();
    folder_.keep();
    return report_;
  }

 private:
  static constexpr const char* beside = ", so that no other frames stand among these";
  const ConvertJob& job_;
  NewFolder folder_;
  std::vector<read::FrameFile> frames_;
  std::vector<Written> written_;  // of each frame
  ConvertReport report_;
  std::optional<Temporary> whole_;

  std::string_view ending() const { return endings[static_cast<std::size_t>(job_.format)]; }
  std::string name_of(std::size_t k) const {
    return fmt::format("{}{:06}.{}", job_.format == Format::vtp ? "frames/" : "", k, ending());
  }

  void told(std::size_t done) const {
    if (job_.progress && !job_.progress(done, frames_.size()))
      throw WorkError("stopped; nothing was written");
  }

  /// Each frame in a process of its own: VTK's readers are not made for threads, and what a frame took is given back. They
  /// are started and asked for by this one thread, in order.
  void side_by_side() {
    std::deque<Child> running;
    std::size_t done = 1;
    const auto take_first = [&] {
      written_[done] = written_from(running.front().result());
      running.pop_front();
      told(++done);
    };
    for (std::size_t k = 1; k < frames_.size(); ++k) {
      if (running.size() == static_cast<std::size_t>(job_.jobs)) take_first();
      running.emplace_back(
          [this, k] { return text_of(add(k)); },
          fmt::format("{}: cannot be converted: the process that read it ended", frames_[k].path.string()));
    }
    while (!running.empty()) take_first();
  }

  Written add(std::size_t k) {
    const auto& file = frames_[k];
    const auto frame = read::parse_frame(read::read_files(file), job_.meanings);
    const FrameFacts facts{k, frame.time ? frame.time : file.time, job_.from_one};
    const auto bytes = bytes_of(frame, facts);
    if (k == 0) {
      folder_.make();
      if (job_.format == Format::vtp) fs::create_directory(job_.folder / "frames");
    }
    if (job_.one_file) {
      if (!whole_) whole_.emplace(job_.folder / fmt::format("frames.{}", ending()));
      whole_->write(bytes);
    } else {
      write_atomically(job_.folder / name_of(k), bytes, Flush::later);
    }
    return {facts.time, frame.left_out,
            is_tilted(frame) && (job_.format == Format::vtp || job_.format == Format::csv)};
  }

  std::string bytes_of(const read::GrainFrame& frame, const FrameFacts& facts) const {
    switch (job_.format) {
      case Format::lammps_dump:
        return lammps_dump(frame, facts);
      case Format::xyz:
        return xyz_frame(frame, facts);
      case Format::csv:
        return job_.one_file ? csv_rows(frame, facts, facts.number == 0) : csv_frame(frame, facts);
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
    std::vector<double> times;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < frames_.size(); ++k) {
      times.push_back(written_[k].time.value_or(static_cast<double>(k)));
      names.push_back(name_of(k));
      report_.left_out += written_[k].left_out;
      report_.tilted |= written_[k].tilted;
    }
    report_.frames = frames_.size();
    if (job_.format == Format::vtp) write_atomically(job_.folder / "frames.pvd", pvd(times, names));
  }
};

}  // namespace

ConvertReport convert(const ConvertJob& job) { return Conversion(job).go(); }

}  // namespace chute::write
