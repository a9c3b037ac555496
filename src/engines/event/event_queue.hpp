#pragma once
#include <boost/heap/d_ary_heap.hpp>
#include <cstddef>
#include <vector>

namespace chute::event {

/// Every moving grain's next event, the earliest on top: a change costs O(log N) comparisons. Events at the
/// same time come in the order of the grains.
class EventQueue {
 public:
  struct Entry {
    double time;
    std::size_t grain;
  };

  void clear() {
    heap_.clear();
    handles_.clear();
  }
  /// Grains are added in order: 0, 1, …
  void add(double time) { handles_.push_back(heap_.push({time, handles_.size()})); }
  void set(std::size_t grain, double time) { heap_.update(handles_[grain], {time, grain}); }
  bool empty() const { return heap_.empty(); }
  const Entry& next() const { return heap_.top(); }

 private:
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      return a.time != b.time ? a.time > b.time : a.grain > b.grain;
    }
  };
  using Heap = boost::heap::d_ary_heap<Entry, boost::heap::arity<4>, boost::heap::mutable_<true>,
                                       boost::heap::compare<Later>>;
  Heap heap_;
  std::vector<Heap::handle_type> handles_;
};

}  // namespace chute::event
