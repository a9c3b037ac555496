#include "view/encoder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "common/error.hpp"
#include "common/no_broken_pipe.hpp"

extern char** environ;

namespace chute::view {
Encoder::Encoder(const std::vector<std::string>& arguments) : name_(arguments.at(0)) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw WorkError(fmt::format("{}: no pipe: {}", name_, std::strerror(errno)));
  said_ = ::memfd_create("said", MFD_CLOEXEC);
  std::vector<char*> words;
  for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, said_, STDERR_FILENO);
  posix_spawnattr_t
      own_group;  // an interrupt from the keyboard is for this program, which then ends the other
  posix_spawnattr_init(&own_group);
  sigset_t usual;  // what this program ignores is not the other's business
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&own_group, &usual);
  posix_spawnattr_setflags(&own_group, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  pid_t process = -1;
  const int error = ::posix_spawnp(&process, words[0], &actions, &own_group, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&own_group);
  ::close(ends[0]);
  if (error != 0) {
    ::close(ends[1]);
    ::close(said_);
    throw WorkError(error == ENOENT ? fmt::format("{} is not installed, and movies need it", name_)
                                    : fmt::format("{} cannot be started: {}", name_, std::strerror(error)));
  }
  process_ = process, input_ = ends[1];
  ::fcntl(input_, F_SETPIPE_SZ, 1 << 20);  // fewer switches between the two programs; a refusal does no harm
}

Encoder::~Encoder() {
  if (process_ > 0) {
    ::kill(process_, SIGKILL);
    wait();
  }
  if (said_ >= 0) ::close(said_);
}

int Encoder::wait() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

std::string Encoder::last_words() const {
  std::string text(4096, '\0');
  const auto size = ::lseek(said_, 0, SEEK_END);
  const auto count = ::pread(said_, text.data(), text.size(), std::max<off_t>(0, size - 4096));
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.find_last_of("\r\n") + 1);
}

void Encoder::fail() {
  const int status = process_ > 0 ? wait() : 0;
  auto text = last_words();
  if (WIFSIGNALED(status))
    text = fmt::format("ended by signal {}{}", WTERMSIG(status),
                       WTERMSIG(status) == SIGKILL ? ", out of memory?" : "");
  if (text.empty()) text = "it says nothing about why";
  throw WorkError(fmt::format("{} failed: {}", name_, text));
}

void Encoder::write(const void* bytes, std::size_t count) {
  const NoBrokenPipe guard;
  const char* from = static_cast<const char*>(bytes);
  while (count > 0) {
    const auto written = ::write(input_, from, count);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail();
    from += written, count -= static_cast<std::size_t>(written);
  }
}

void Encoder::finish() {
  const int status = wait();
  if (WIFSIGNALED(status)) throw WorkError(fmt::format("{} was ended by signal {}", name_, WTERMSIG(status)));
  // It may complain, of a full disk for instance, and yet say that all is well.
  if (WEXITSTATUS(status) != 0 || !last_words().empty()) fail();
}

}  // namespace chute::view
