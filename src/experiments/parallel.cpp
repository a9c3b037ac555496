#include "experiments/parallel.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace chute::experiments {

void for_each(std::size_t count, int jobs, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next = 0;
  std::exception_ptr error;
  std::mutex guard;
  const auto worker = [&] {
    for (std::size_t k; (k = next++) < count;) try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!error) error = std::current_exception();
        next = count;
      }
  };
  std::vector<std::jthread> others;
  for (int w = 1; w < jobs; ++w) others.emplace_back(worker);
  worker();
  others.clear();  // joins
  if (error) std::rethrow_exception(error);
}

}  // namespace chute::experiments
