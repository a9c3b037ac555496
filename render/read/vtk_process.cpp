#include "read/vtk_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <mutex>
#include <set>
#include <string_view>

#include "common/address_space.hpp"
#include "common/error.hpp"
#include "common/no_broken_pipe.hpp"
#include "read/vtk_any.hpp"

extern char** environ;

namespace chute::read {
namespace fs = std::filesystem;
namespace {

constexpr const char* word = "--read-vtk-files-for-another";
bool can_be_started = false;

// What a file may take. Packed ones hold more than their size, at most a thousand times as much of zeros; VTK's structures and the
// copies here take a few times what is read.
constexpr std::uint64_t memory_at_least =
    1U << 30U;  // bytes beyond what the program takes when it has read nothing
constexpr std::uint64_t memory_per_byte = 64;
constexpr double seconds_at_least = 20, seconds_per_megabyte = 2;

// --- what goes through the pipes: numbers as they lie in memory, for both ends are one program ---

bool read_all(int file, void* to, std::size_t count) {
  auto* bytes = static_cast<char*>(to);
  while (count > 0) {
    const auto got = ::read(file, bytes, count);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got, count -= static_cast<std::size_t>(got);
  }
  return true;
}

bool write_all(int file, const void* from, std::size_t count) {
  const auto* bytes = static_cast<const char*>(from);
  while (count > 0) {
    const auto put = ::write(file, bytes, count);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    bytes += put, count -= static_cast<std::size_t>(put);
  }
  return true;
}

class Writer {
 public:
  explicit Writer(int file) : file_(file) {}
  void number(std::uint64_t value) { good_ = good_ && write_all(file_, &value, sizeof value); }
  void text(std::string_view text) {
    number(text.size());
    good_ = good_ && write_all(file_, text.data(), text.size());
  }
  void values(const std::vector<double>& values) {
    number(values.size());
    good_ = good_ && write_all(file_, values.data(), values.size() * sizeof(double));
  }
  bool good() const { return good_; }

 private:
  int file_;
  bool good_ = true;
};

/// The other end is gone, or late.
struct Broken {
  bool late = false;
};

class Reader {
 public:
  using Clock = std::chrono::steady_clock;
  Reader(int file, Clock::time_point end) : file_(file), end_(end) {}
  std::uint64_t number() {
    std::uint64_t value = 0;
    bytes(&value, sizeof value);
    return value;
  }
  std::string text() {
    std::string text(number(), '\0');
    bytes(text.data(), text.size());
    return text;
  }
  std::vector<double> values() {
    std::vector<double> values(number());
    bytes(values.data(), values.size() * sizeof(double));
    return values;
  }

 private:
  int file_;
  Clock::time_point end_;

  void bytes(void* to, std::size_t count) {
    auto* at = static_cast<char*>(to);
    while (count > 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end_ - Clock::now()).count();
      pollfd wait{file_, POLLIN, 0};
      const int ready =
          left > 0 ? ::poll(&wait, 1, static_cast<int>(std::min<long long>(left, 1'000'000))) : 0;
      if (ready < 0 && errno == EINTR) continue;
      if (ready == 0 && left <= 0) throw Broken{true};
      if (ready == 0) continue;
      const auto got = ::read(file_, at, count);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw Broken{};
      at += got, count -= static_cast<std::size_t>(got);
    }
  }
};

void put(Writer& out, const std::vector<PointArray>& arrays) {
  out.number(arrays.size());
  for (const auto& array : arrays) {
    out.text(array.name), out.number(static_cast<std::uint64_t>(array.components)), out.values(array.values);
    out.number(array.words.size());
    for (const auto& one : array.words) out.text(one);
  }
}

std::vector<PointArray> take_arrays(Reader& in) {
  std::vector<PointArray> arrays(in.number());
  for (auto& array : arrays) {
    array.name = in.text(), array.components = static_cast<int>(in.number()), array.values = in.values();
    array.words.resize(in.number());
    for (auto& one : array.words) one = in.text();
  }
  return arrays;
}

void put(Writer& out, const PointSet& set) {
  for (const auto* values : {&set.x, &set.y, &set.z}) out.values(*values);
  put(out, set.point_arrays), put(out, set.field_arrays);
  out.number(set.field_texts.size());
  for (const auto& [name, text] : set.field_texts) out.text(name), out.text(text);
  out.number(set.cells_in_all);
}

PointSet take_set(Reader& in) {
  PointSet set;
  for (auto* values : {&set.x, &set.y, &set.z}) *values = in.values();
  set.point_arrays = take_arrays(in), set.field_arrays = take_arrays(in);
  set.field_texts.resize(in.number());
  for (auto& [name, text] : set.field_texts) name = in.text(), text = in.text();
  set.cells_in_all = in.number();
  for (const auto& array : set.point_arrays) set.point_names.push_back(array.name);
  return set;
}

void put(Writer& out, const ImageData& grid) {
  out.values({grid.origin.begin(), grid.origin.end()}),
      out.values({grid.spacing.begin(), grid.spacing.end()});
  for (const int count : grid.points) out.number(static_cast<std::uint64_t>(count));
  out.values(grid.time ? std::vector<double>{*grid.time} : std::vector<double>());
  out.text(grid.units), out.text(grid.clock);
  put(out, grid.cell_arrays), put(out, grid.point_arrays);
}

ImageData take_grid(Reader& in) {
  ImageData grid;
  for (auto* place : {&grid.origin, &grid.spacing}) {
    const auto values = in.values();
    std::copy_n(values.begin(), std::min(values.size(), place->size()), place->begin());
  }
  for (int& count : grid.points) count = static_cast<int>(in.number());
  if (const auto time = in.values(); !time.empty()) grid.time = time[0];
  grid.units = in.text(), grid.clock = in.text();
  grid.cell_arrays = take_arrays(in), grid.point_arrays = take_arrays(in);
  return grid;
}

/// What a file is read as.
enum class As : std::uint64_t { points, grid };

// --- the process that reads ---

std::uint64_t memory_now() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void serve(int requests, int replies) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const auto at_first = memory_now();
  As as{};
  while (read_all(requests, &as, sizeof as)) {
    std::uint64_t size = 0, length = 0;
    if (!read_all(requests, &size, sizeof size) || !read_all(requests, &length, sizeof length)) break;
    std::string path(length, '\0');
    if (!read_all(requests, path.data(), length)) break;
    limit_address_space(at_first + memory_at_least + memory_per_byte * size);
    Writer out(replies);
    std::string fault;
    try {
      const auto answer = [&](const auto& found) { out.number(1), put(out, found); };
      as == As::grid ? answer(read_image_pieces(path)) : answer(read_any_vtk(path));
    } catch (const std::bad_alloc&) {
      fault = "damaged: it asks for more memory than a file of its size should";
    } catch (const std::exception& error) {
      fault = fmt::format("damaged or cut short: {}", error.what());
    }
    if (!fault.empty()) out.number(0), out.text(fault);
    if (!out.good()) break;
  }
  std::_Exit(0);
}

// --- the process that asks ---

class Process {
 public:
  ~Process() { stop(); }

  /// `take` takes what it answers.
  template <class Found>
  Found ask(As as, const fs::path& path, std::uint64_t size, Found (*take)(Reader&)) {
    if (owner_ != ::getpid()) forget();
    if (process_ < 0) start();
    const NoBrokenPipe guard;
    const auto seconds = seconds_at_least + seconds_per_megabyte * static_cast<double>(size) / 1e6;
    const auto end = Reader::Clock::now() + std::chrono::milliseconds(static_cast<long long>(1000 * seconds));
    try {
      Writer out(requests_);
      out.number(static_cast<std::uint64_t>(as)), out.number(size), out.text(path.string());
      if (!out.good()) throw Broken{};
      Reader in(replies_, end);
      if (in.number() == 1) return take(in);
      throw InputError(fmt::format("{}: {}", path.string(), in.text()));
    } catch (const Broken& broken) {
      const auto how = broken.late ? fmt::format("VTK has not read it within {:.0f} s", seconds)
                                   : "damaged: VTK's reader " + last_words();
      stop();
      throw InputError(fmt::format("{}: {}", path.string(), how));
    }
  }

 private:
  pid_t process_ = -1, owner_ = -1;
  int requests_ = -1, replies_ = -1;

  void start() {
    int requests[2], replies[2];
    if (::pipe2(requests, O_CLOEXEC) != 0 || ::pipe2(replies, O_CLOEXEC) != 0)
      throw WorkError(fmt::format("no pipe: {}", std::strerror(errno)));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, requests[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, replies[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t own_group;  // an interrupt from the keyboard is for the program that asks
    posix_spawnattr_init(&own_group);
    posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP);
    char program[] = "chute", argument[32];
    std::strncpy(argument, word, sizeof argument - 1), argument[sizeof argument - 1] = '\0';
    char* words[] = {program, argument, nullptr};
    pid_t process = -1;
    const int error = ::posix_spawn(&process, "/proc/self/exe", &actions, &own_group, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&own_group);
    ::close(requests[0]), ::close(replies[1]);
    if (error != 0) {
      ::close(requests[1]), ::close(replies[0]);
      throw WorkError(fmt::format("no process to read VTK's files in: {}", std::strerror(error)));
    }
    process_ = process, owner_ = ::getpid(), requests_ = requests[1], replies_ = replies[0];
  }

  /// A forked process has its parent's ends of the pipes: they are not its own.
  void forget() {
    if (requests_ >= 0) ::close(requests_), ::close(replies_);
    process_ = -1, requests_ = replies_ = -1;
  }

  std::string last_words() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return WIFSIGNALED(status) ? fmt::format("was ended by signal {}", WTERMSIG(status)) : "ended early";
  }

  void stop() {
    if (owner_ != ::getpid()) return forget();
    if (process_ >= 0) {
      ::kill(process_, SIGKILL);
      while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
      }
    }
    forget();
  }
};

std::mutex one_at_a_time;
Process process;

template <class Found>
Found ask(As as, const fs::path& path, const std::vector<std::string>& named, Found (*take)(Reader&)) {
  std::error_code error;
  std::uint64_t size = fs::file_size(path, error);
  if (error) throw InputError(fmt::format("{}: cannot read: {}", path.string(), error.message()));
  std::set<fs::path> files;  // one that is named often is not larger for that
  for (const auto& name : named) files.insert(fs::weakly_canonical(path.parent_path() / name, error));
  for (const auto& file : files)
    if (const auto more = fs::file_size(file, error); !error) size += more;
  const std::lock_guard lock(one_at_a_time);
  return process.ask(as, path, size, take);
}

}  // namespace

bool serve_vtk_files(int argc, char** argv) {
  can_be_started = true;
  if (argc != 2 || std::string_view(argv[1]) != word) return false;
  serve(STDIN_FILENO, STDOUT_FILENO);
}

bool has_vtk_process() { return can_be_started; }

PointSet read_by_vtk(const fs::path& path, const std::vector<std::string>& named) {
  return ask(As::points, path, named, take_set);
}

ImageData image_by_vtk(const fs::path& path, const std::vector<std::string>& named) {
  return ask(As::grid, path, named, take_grid);
}

}  // namespace chute::read
