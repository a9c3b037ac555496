#include "common/in_child.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <exception>
#include <utility>

#include "common/address_space.hpp"
#include "common/error.hpp"

namespace chute {
namespace {

/// First byte of what a child sends.
constexpr char it_worked = '+', it_threw = '-';

bool send(int to, const char* data, std::size_t size) {
  while (size > 0) {
    const auto written = ::write(to, data, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

[[noreturn]] void live_as_child(int to, pid_t parent, const std::function<std::string()>& work,
                                std::size_t most_bytes) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGFPE, SIGABRT, SIGBUS})
    std::signal(signal, SIG_DFL);
  // What nobody waits for any more would keep files and locks of its parent's open for as long as it reads.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  limit_address_space(most_bytes);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::string answer(1, it_worked);
  try {
    answer += work();
  } catch (const std::exception& error) {
    answer = std::string(1, it_threw) + error.what();
  }
  ::_exit(send(to, answer.data(), answer.size()) ? 0 : 1);
}

/// A terminal sends its signals to all processes of a command: such an end says nothing about what was read.
bool was_told_to_stop(int status) {
  if (!WIFSIGNALED(status)) return false;
  const int signal = WTERMSIG(status);
  return signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
}

}  // namespace

Child::Child(const std::function<std::string()>& work, std::string when_it_dies, std::size_t most_bytes)
    : when_it_dies_(std::move(when_it_dies)) {
  int ends[2];
  if (::pipe(ends) != 0) throw WorkError("no pipe to a reading process can be had");
  const auto parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    ::close(ends[0]);
    live_as_child(ends[1], parent, work, most_bytes);
  }
  ::close(ends[1]);
  from_ = ends[0];
  if (process_ < 0) {
    ::close(from_);
    throw WorkError("no reading process can be had");
  }
}

Child::~Child() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  wait();
}

int Child::wait() {
  ::close(from_);
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return status;
}

std::string Child::result() {
  std::string answer;
  char buffer[65536];
  for (;;) {
    const auto got = ::read(from_, buffer, sizeof buffer);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    answer.append(buffer, static_cast<std::size_t>(got));
  }
  const int status = wait();
  if (was_told_to_stop(status)) throw WorkError("stopped");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || answer.empty()) throw InputError(when_it_dies_);
  if (answer[0] == it_threw) throw InputError(answer.substr(1));
  return answer.substr(1);
}

std::string in_child(const std::function<std::string()>& work, const std::string& when_it_dies,
                     std::size_t most_bytes) {
  return Child(work, when_it_dies, most_bytes).result();
}

}  // namespace chute
