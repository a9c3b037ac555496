#pragma once
#include <cstddef>
#include <vector>

namespace chute {

/// One value for every two of some materials, whichever of the two comes first. Empty where there is nothing to tell apart.
template <class Value>
class ByPair {
 public:
  ByPair() = default;
  ByPair(std::size_t materials, const Value& all)
      : materials_(materials), values_(materials * materials, all) {}

  bool empty() const { return values_.empty(); }
  std::size_t materials() const { return materials_; }
  const Value& operator()(int a, int b) const { return values_[index(a, b)]; }
  void set(int a, int b, const Value& value) { values_[index(a, b)] = values_[index(b, a)] = value; }
  /// Of materials a and b at a · materials() + b.
  const std::vector<Value>& values() const { return values_; }

 private:
  std::size_t materials_ = 0;
  std::vector<Value> values_;

  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(a) * materials_ + static_cast<std::size_t>(b);
  }
};

}  // namespace chute
