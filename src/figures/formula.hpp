#pragma once
#include <memory>
#include <string>
#include <vector>

namespace chute::figures {

/// A formula of x, such as "0.3*(1-exp(-x/2))", read by muParser: + − * / ^, comparisons, ?:, sqrt, exp, ln, log10, sin, tan,
/// atan, abs, min, max …, and the numbers pi and e. Other names are parameters.
class Formula {
 public:
  /// `parameters`: the names that it may have besides x. InputError that says what is wrong and where in the text.
  explicit Formula(const std::string& text, const std::vector<std::string>& parameters = {});
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) = delete;

  /// Its value; NaN or infinite where it has none. `values`: of the parameters, in their order.
  double at(double x, const std::vector<double>& values = {}) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace chute::figures
