#include "common/side_by_side.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "common/error.hpp"

namespace chute {

void side_by_side(std::size_t count, int jobs, const Report& progress,
                  const std::function<void(std::size_t k, const Report& report)>& work) {
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> stop = false;
  std::mutex guard;
  std::vector<double> part(count);
  std::exception_ptr error;

  const auto worker = [&] {
    for (std::size_t k; !stop && (k = next++) < count;) {
      const auto report = [&](double done) {
        const std::lock_guard lock(guard);
        part[k] = done;
        if (!progress(std::accumulate(part.begin(), part.end(), 0.0) / static_cast<double>(count)))
          stop = true;
        return !stop;
      };
      try {
        work(k, report);
        if (!report(1)) throw WorkError("stopped");
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!error) error = std::current_exception();
        stop = true;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int w = 1; w < jobs && static_cast<std::size_t>(w) < count; ++w) others.emplace_back(worker);
    worker();
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace chute
