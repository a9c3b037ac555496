#include "view/crew.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <thread>
#include <vector>

#include "common/error.hpp"
#include "common/no_broken_pipe.hpp"

namespace chute::view {
namespace {

constexpr int slots = 2;  // per worker: it draws one picture while the other is taken

struct Order {
  std::uint64_t number;
  std::int32_t slot;
};
enum class Answer : std::int32_t { drawn, kept, input_error, work_error };
struct Reply {
  std::uint64_t number;
  Answer answer;
  std::int32_t slot;
  char message[1000];
};
static_assert(sizeof(Reply) < 4096);  // a pipe takes that much in one piece

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

/// Memory that a process and its children share.
struct Shared {
  std::size_t size;
  void* memory;
  explicit Shared(std::size_t bytes) : size(std::max<std::size_t>(bytes, 1)) {
    memory = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw WorkError("no memory for the pictures");
  }
  ~Shared() { ::munmap(memory, size); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
};

/// What a worker process does until its orders end. Never returns.
[[noreturn]] void work(int orders, int replies, std::uint8_t* pixels, std::size_t picture_bytes, bool wanted,
                       const std::function<Draw()>& make_draw) {
  Draw draw;
  image::Image picture;
  Order order;
  while (read_all(orders, &order, sizeof order)) {
    Reply reply{};
    reply.number = order.number, reply.slot = order.slot;
    const auto say = [&](Answer answer, const char* what) {
      reply.answer = answer;
      std::strncpy(reply.message, what, sizeof reply.message - 1);
    };
    try {
      if (!draw) draw = make_draw();
      reply.answer = draw(order.number, wanted, picture) ? Answer::drawn : Answer::kept;
      if (wanted)
        std::memcpy(pixels + static_cast<std::size_t>(order.slot) * picture_bytes, picture.rgba.data(),
                    picture_bytes);
    } catch (const InputError& error) {
      say(Answer::input_error, error.what());
    } catch (const std::exception& error) {
      say(Answer::work_error, error.what());
    }
    if (!write_all(replies, &reply, sizeof reply)) break;
  }
  std::_Exit(0);  // without the parent's destructors
}

class Worker {
 public:
  Worker(std::size_t picture_bytes, bool wanted, const std::function<Draw()>& make_draw,
         const std::vector<int>& others)
      : pixels_(wanted ? slots * picture_bytes : 0) {
    int orders[2], replies[2];
    if (::pipe(orders) != 0 || ::pipe(replies) != 0)
      throw WorkError(fmt::format("no pipe: {}", std::strerror(errno)));
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ < 0) throw WorkError(fmt::format("no process to draw in: {}", std::strerror(errno)));
    if (process_ == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) std::_Exit(1);
      for (int file : others) ::close(file);  // else a sibling would not see its orders end
      ::close(orders[1]), ::close(replies[0]);
      work(orders[0], replies[1], static_cast<std::uint8_t*>(pixels_.memory), picture_bytes, wanted,
           make_draw);
    }
    ::close(orders[0]), ::close(replies[1]);
    orders_ = orders[1], replies_ = replies[0];
  }
  ~Worker() {
    ::close(orders_), ::close(replies_);
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);  // it has nothing to finish: its files appear whole or not at all
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  void order(std::size_t number, int slot) {
    const Order order{number, slot};
    write_all(orders_, &order, sizeof order);
  }
  Reply reply() {
    Reply reply{};
    if (!read_all(replies_, &reply, sizeof reply)) throw WorkError("a process that draws frames " + end());
    if (reply.answer == Answer::input_error) throw InputError(reply.message);
    if (reply.answer == Answer::work_error) throw WorkError(reply.message);
    return reply;
  }
  const std::uint8_t* pixels(int slot, std::size_t picture_bytes) const {
    return static_cast<const std::uint8_t*>(pixels_.memory) + static_cast<std::size_t>(slot) * picture_bytes;
  }
  int orders() const { return orders_; }
  int replies() const { return replies_; }

 private:
  /// How it ended, in words.
  std::string end() {
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL)
      return "was ended by force, perhaps for want of memory; fewer --jobs take less";
    return WIFSIGNALED(status) ? fmt::format("was ended by signal {}", WTERMSIG(status)) : "ended early";
  }

  Shared pixels_;
  pid_t process_ = -1;
  int orders_ = -1, replies_ = -1;
};

/// A child has only the thread that forked. If there are others (Mesa's, once this process has drawn), what
/// they were doing or would have to do is lost in it.
bool has_threads() {
  std::error_code error;
  const std::filesystem::directory_iterator tasks("/proc/self/task", error);
  return error || std::distance(begin(tasks), end(tasks)) > 1;
}

void draw_here(std::size_t count, bool wanted, const std::function<Draw()>& make_draw, const Take& take) {
  const Draw draw = make_draw();
  image::Image picture;
  for (std::size_t i = 0; i < count; ++i) {
    const bool drawn = draw(i, wanted, picture);
    take(i, drawn, picture);
  }
}

}  // namespace

void draw_all(std::size_t count, int jobs, int width, int height, bool wanted,
              const std::function<Draw()>& make_draw, const Take& take) {
  if (jobs <= 1 || count <= 1 || has_threads()) return draw_here(count, wanted, make_draw, take);
  const NoBrokenPipe guard;  // a worker that has died is noticed when it does not reply
  const std::size_t picture_bytes = 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto crew_size = std::min<std::size_t>(static_cast<std::size_t>(jobs), count);
  // Mesa draws with a thread per processor in every process; shared out, they do not get in each other's way
  const auto threads = std::max<std::size_t>(1, std::thread::hardware_concurrency() / crew_size);
  ::setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 0);

  std::vector<std::unique_ptr<Worker>> crew;
  std::vector<int> ends;
  for (std::size_t i = 0; i < crew_size; ++i) {
    crew.push_back(std::make_unique<Worker>(picture_bytes, wanted, make_draw, ends));
    ends.insert(ends.end(), {crew.back()->orders(), crew.back()->replies()});
  }
  std::size_t next = 0, taken = 0;
  for (int slot = 0; slot < slots; ++slot)
    for (auto& worker : crew)
      if (next < count) worker->order(next++, slot);

  struct Done {
    std::size_t worker;
    int slot;
    bool drawn;
  };
  std::map<std::size_t, Done> done;  // out of turn
  image::Image picture;
  if (wanted) picture = image::Image(width, height);
  while (taken < count) {
    std::vector<pollfd> files;
    for (const auto& worker : crew) files.push_back({worker->replies(), POLLIN, 0});
    if (::poll(files.data(), files.size(), -1) < 0 && errno != EINTR)
      throw WorkError(fmt::format("waiting for pictures: {}", std::strerror(errno)));
    for (std::size_t w = 0; w < crew.size(); ++w) {
      if (!files[w].revents) continue;
      const Reply reply = crew[w]->reply();
      done[reply.number] = {w, reply.slot, reply.answer == Answer::drawn};
    }
    for (auto first = done.begin(); first != done.end() && first->first == taken; first = done.begin()) {
      const Done ready = first->second;
      if (wanted)
        std::memcpy(picture.rgba.data(), crew[ready.worker]->pixels(ready.slot, picture_bytes),
                    picture_bytes);
      if (next < count) crew[ready.worker]->order(next++, ready.slot);
      take(taken, ready.drawn, picture);
      ++taken;
      done.erase(first);
    }
  }
}

}  // namespace chute::view
