#include "engines/lammps/lammps_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>
#include <vector>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "common/programs.hpp"

namespace chute::lammps {
namespace fs = std::filesystem;
namespace {

constexpr const char* said = "said";  // what LAMMPS and mpirun write, in its folder

/// The environment, with one thread a process: ranks share the cores among them. A process alone needs no daemon of Open
/// MPI's, which takes as long to start as LAMMPS itself.
std::vector<std::string> environment(bool alone) {
  std::vector<std::string> all;
  for (char** entry = environ; *entry; ++entry)
    if (std::strncmp(*entry, "OMP_NUM_THREADS=", 16) != 0) all.emplace_back(*entry);
  all.emplace_back("OMP_NUM_THREADS=1");
  if (alone) all.emplace_back("OMPI_MCA_ess_singleton_isolated=1");
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (auto& text : texts) all.push_back(text.data());
  all.push_back(nullptr);
  return all;
}

/// The command so that it is killed when the thread that started it ends, in whatever way: a chute that is killed closes no
/// connection in order, LAMMPS sees that its input has ended only when it has done the steps that it was told, and mpirun
/// puts each rank into a process group of its own, where a signal for mpirun's does not reach it. The kernel keeps that
/// wish over exec; setpriv, of the essential package util-linux, has it noted between fork and exec, which posix_spawn
/// cannot.
std::vector<std::string> bound_to_parent(std::vector<std::string> words) {
  if (!find_program("setpriv").empty()) words.insert(words.begin(), {"setpriv", "--pdeathsig", "KILL"});
  return words;
}

void refuse_what_is_missing(int ranks) {
  if (find_program("lmp").empty())
    throw InputError(
        "engine.method: \"lammps\" needs the program lmp, Debian's package lammps: apt-get install lammps");
  if (ranks > 1 && find_program("mpirun").empty())
    throw InputError("--ranks: several need mpirun, Debian's package mpi-default-bin");
  constexpr int most_a_core = 16;  // far more do not start within minutes
  const int most = most_a_core * static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (ranks > most)
    throw InputError(
        fmt::format("--ranks {}: at most {} here, {} for each core; no more than cores is fastest", ranks,
                    most, most_a_core));
}

}  // namespace

LammpsProcess::LammpsProcess(int ranks) : scratch_("lammps") { start(ranks); }

void LammpsProcess::start(int ranks) {
  refuse_what_is_missing(ranks);
  auto words = bound_to_parent({"lmp", "-log", "none", "-nocite"});
  if (ranks > 1) {
    std::vector<std::string> mpi{"mpirun", "-n", std::to_string(ranks), "--oversubscribe"};
    if (::geteuid() == 0) mpi.emplace_back("--allow-run-as-root");
    mpi.insert(mpi.end(), words.begin(), words.end());
    words = bound_to_parent(std::move(mpi));
  }
  int pipe[2];
  if (::pipe2(pipe, O_CLOEXEC) != 0)
    throw WorkError(fmt::format("a pipe to LAMMPS: {}", std::strerror(errno)));
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, pipe[0], 0);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder().c_str());
  ::posix_spawn_file_actions_addopen(&actions, 1, said, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::posix_spawn_file_actions_adddup2(&actions, 1, 2);
  // A Ctrl-C is for chute, which ends LAMMPS in order.
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  auto texts = environment(ranks == 1);
  auto given = pointers(words), around = pointers(texts);
  const int error = ::posix_spawnp(&process_, given[0], &actions, &attributes, given.data(), around.data());
  ::posix_spawn_file_actions_destroy(&actions);
  ::posix_spawnattr_destroy(&attributes);
  ::close(pipe[0]);
  input_ = pipe[1];
  if (error != 0) throw WorkError(fmt::format("{}: cannot be started: {}", words[0], std::strerror(error)));
}

LammpsProcess::~LammpsProcess() {
  if (input_ >= 0) ::close(input_);  // LAMMPS ends with its input
  if (process_ > 0) {
    constexpr int patience = 200;  // times 10 ms
    for (int k = 0; k < patience && !has_ended(); ++k)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    if (process_ > 0) {
      ::kill(-process_, SIGKILL);
      int status = 0;
      ::waitpid(process_, &status, 0);
    }
  }
}

bool LammpsProcess::has_ended() {
  if (process_ <= 0) return true;
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return false;
  process_ = -1;
  return true;
}

void LammpsProcess::send(std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(input_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail();
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// LAMMPS ended before its work was done: its own words say why.
void LammpsProcess::fail() {
  std::string text, why;
  try {
    text = read_file(folder() / said);
  } catch (const std::exception&) {
    // then there is nothing that it said
  }
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    const auto line = text.substr(at, end - at);
    if (line.starts_with("ERROR")) {
      why = line;
      break;
    }
    if (!line.empty()) why = line;
    at = end + 1;
  }
  throw WorkError(fmt::format("LAMMPS stopped: {}", why.empty() ? "it said nothing" : why));
}

void LammpsProcess::command(const std::string& commands) {
  // A file that appears when all before it is done: what LAMMPS writes to its screen may stay in a buffer.
  const auto mark = folder() / fmt::format("done-{}", ++marks_);
  send(fmt::format("{}print done file done-{} screen no\n", commands, marks_));
  auto pause = std::chrono::microseconds(50);
  constexpr auto longest = std::chrono::microseconds(5000);
  std::error_code error;
  while (!fs::exists(mark, error)) {
    if (has_ended()) fail();
    std::this_thread::sleep_for(pause);
    pause = std::min(longest, pause * 5 / 4);
  }
  fs::remove(mark, error);
}

}  // namespace chute::lammps
