#pragma once
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace chute {

/// A part [begin, end) of an array.
struct Part {
  std::size_t begin, end;
  std::size_t size() const { return end - begin; }
};

/// Threads that stay, so that work of a few microseconds can be shared out. Nothing that they compute may
/// depend on how many there are: work is split into ranges of elements that do not know of each other, and
/// sums are done by one. Members compute in the floating-point mode of the caller (see FlushSubnormals).
class Team {
 public:
  /// `members` ≥ 1, the caller among them.
  explicit Team(int members = 1) {
    for (int k = 1; k < members; ++k)
      threads_.emplace_back([this, k] { serve(static_cast<std::size_t>(k)); });
  }
  ~Team() {
    job_ = nullptr;
    publish();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  std::size_t size() const { return threads_.size() + 1; }

  /// work(k) on each member k, all at the same time; comes back when all are done. `work` must not throw.
  template <class Work>
  void run(const Work& work) {
    if (threads_.empty()) return work(std::size_t{0});
    job_ = [](const void* w, std::size_t k) { (*static_cast<const Work*>(w))(k); };
    work_ = &work;
    mode_ = _mm_getcsr();
    busy_.store(threads_.size(), std::memory_order_relaxed);
    publish();
    work(std::size_t{0});
    await([&] { return busy_.load(std::memory_order_acquire) == 0; }, busy_);
  }

  /// The part of `count` elements that falls to member k, in whole cache lines of doubles.
  Part part(std::size_t count, std::size_t k) const {
    const auto cut = [&](std::size_t at) { return at == size() ? count : count * at / size() / 8 * 8; };
    return {cut(k), cut(k + 1)};
  }
  /// work(part, k) for each member's part of `count` elements.
  template <class Work>
  void split(std::size_t count, const Work& work) {
    run([&](std::size_t k) { work(part(count, k), k); });
  }

  /// Nobody but the caller.
  static Team& alone() {
    static Team team;
    return team;
  }

 private:
  void (*job_)(const void*, std::size_t) = nullptr;  // nullptr: go home
  const void* work_ = nullptr;
  unsigned mode_ = 0;
  alignas(64) std::atomic<std::size_t> round_ = 0;
  alignas(64) std::atomic<std::size_t> busy_ = 0;
  std::vector<std::jthread> threads_;  // last: they go before what they use

  void publish() {
    round_.fetch_add(1, std::memory_order_release);
    round_.notify_all();
  }
  void serve(std::size_t k) {
    for (std::size_t seen = 0;;) {
      await([&] { return round_.load(std::memory_order_acquire) != seen; }, round_);
      ++seen;
      if (!job_) return;
      _mm_setcsr(mode_);
      job_(work_, k);
      if (busy_.fetch_sub(1, std::memory_order_release) == 1) busy_.notify_all();
    }
  }
  /// Spins, for the other side is mostly about to come, and gives way now and then, for it may be waiting for
  /// this processor; sleeps after about a millisecond, for waking up takes longer than most waits.
  template <class Done>
  static void await(const Done& done, std::atomic<std::size_t>& flag) {
    constexpr int yields = 200, spins = 200;
    for (int y = 0; y < yields; ++y) {
      for (int k = 0; k < spins; ++k) {
        if (done()) return;
        __builtin_ia32_pause();
      }
      std::this_thread::yield();
    }
    for (auto value = flag.load(std::memory_order_acquire); !done();
         value = flag.load(std::memory_order_acquire))
      flag.wait(value, std::memory_order_acquire);
  }
};

}  // namespace chute
