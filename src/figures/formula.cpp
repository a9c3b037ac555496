#include "figures/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <numbers>

#include "common/error.hpp"

namespace chute::figures {

struct Formula::State {
  double x = 0;
  std::vector<double> values;
  mu::Parser parser;
};

Formula::Formula(const std::string& text, const std::vector<std::string>& parameters)
    : state_(std::make_unique<State>()) {
  state_->values.resize(parameters.size());
  auto& parser = state_->parser;
  try {
    parser.DefineConst("pi", std::numbers::pi);
    if (std::ranges::find(parameters, "e") == parameters.end()) parser.DefineConst("e", std::numbers::e);
    parser.DefineVar("x", &state_->x);
    for (std::size_t k = 0; k < parameters.size(); ++k) parser.DefineVar(parameters[k], &state_->values[k]);
    parser.SetExpr(text);
    parser.Eval();
  } catch (const mu::ParserError& error) {
    auto what = error.GetMsg();
    std::ranges::replace(what, '\n', ' ');
    throw InputError(fmt::format("\"{}\" is no formula of x: {}", text, what));
  }
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;

double Formula::at(double x, const std::vector<double>& values) const {
  state_->x = x;
  std::ranges::copy_n(values.begin(),
                      static_cast<std::ptrdiff_t>(std::min(values.size(), state_->values.size())),
                      state_->values.begin());
  return state_->parser.Eval();
}

}  // namespace chute::figures
