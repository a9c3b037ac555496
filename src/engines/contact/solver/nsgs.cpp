#include "engines/contact/solver/nsgs.hpp"

#include <cstdlib>
#include <cstdio>
#include <Eigen/Dense>

namespace chute::contact {
namespace {
double env(const char* n, double d){ const char* e=getenv(n); return e?atof(e):d; }

template <class System>
void sweep(System& system, Team& team) {
  system.order().visit(team, [&](std::size_t place) {
    system.set(place, system.contact(place).solve(system.without(place), system.impulses()[place]));
  });
}
template <class System>
double residual(System& system, Team& team) {
  constexpr int D = System::dimensions;
  double sum = 0;
  (void)team;
  for (std::size_t i = 0; i < system.order().size(); ++i) {
    const auto& contact = system.contact(i);
    const auto& r = system.impulses()[i];
    const auto f = natural_map<D>(r, system.without(i) + contact.w() * r, contact.friction(), contact.rho());
    sum += dot(f, f);
  }
  return std::sqrt(sum);
}
}  // namespace

template <class System>
Convergence nsgs(System& system, const Goal& goal, Team& team) {
  constexpr int D = System::dimensions;
  const double reference = goal.reference > 0 ? goal.reference : system.reference();
  const int p = env("P", 1), hist = env("H", 5);
  const int PROJ=env("PROJ",0), V=env("V",0);
  const double GROW=env("GROW",2);
  Convergence c;
  auto& r = system.impulses();
  const auto n = r.size();
  using Vector = Eigen::VectorXd;
  Vector w(n * D);
  for (size_t i = 0; i < n; ++i) for (int k = 0; k < D; ++k) w[i * D + k] = std::sqrt(1 / system.contact(i).rho());
  Eigen::MatrixXd dF(n * D, hist), dG(n * D, hist);
  Vector x(n * D), g(n * D), f(n * D), pf, pg;
  int have = 0, at = 0;
  double last = 1e300; bool extrapolated=false; double stride=0, S0=env("S0",8);
  auto get = [&](Vector& v) { for (size_t i = 0; i < n; ++i) for (int k = 0; k < D; ++k) v[i * D + k] = r[i][k]; };
  auto put = [&](const Vector& v) { for (size_t i = 0; i < n; ++i) { for (int k = 0; k < D; ++k) r[i][k] = v[i * D + k]; if (PROJ) r[i] = project_on_cone(r[i], system.contact(i).friction()); } system.refresh(team); };
  for (;;) {
    for (int k = 1; k < p; ++k) sweep(system, team), ++c.iterations;
    get(x);
    sweep(system, team), ++c.iterations;
    get(g);
    f = g - x;
    const double step = f.norm() / reference;
    if (step <= goal.tolerance) { c.residual = residual(system, team) / reference; if (c.residual <= goal.tolerance) { c.reached = true; return c; } }
    if (V) printf("%ld %g\n", c.iterations, step);
    if (c.iterations >= goal.iterations) { c.residual = residual(system, team) / reference; return c; }
    if (!hist) continue;
    f = f.cwiseProduct(w);
    double size = f.norm();
    if (size > GROW * last && extrapolated) {
      if (V) printf("rejected, stride %g\n", stride);
      have = 0; at = 0; put(pg); pf.resize(0); extrapolated=false;
      stride = stride > 0 ? stride / 4 : S0; if (stride < 1) stride = 0;
      continue; }
    if (stride > 0 && extrapolated) { if (size < 0.5 * last) { stride = 0; have = 0; at = 0; pf.resize(0);} else stride *= 2; }
    last = size; extrapolated=false;
    if (stride > 0) { pf = f; pg = g; put(g + stride * (g - x)); extrapolated = true; continue; }
    if (pf.size()) {
      dF.col(at) = f - pf; dG.col(at) = g - pg;
      at = (at + 1) % hist; have = std::min(have + 1, hist);
    }
    pf = f; pg = g;
    if (have) {
      Eigen::MatrixXd A = dF.leftCols(have);
      Vector gamma = A.colPivHouseholderQr().solve(f);
      extrapolated=true; put(g - dG.leftCols(have) * gamma);
    }
  }
}

template Convergence nsgs(AssembledSystem<2>&, const Goal&, Team&);
template Convergence nsgs(AssembledSystem<3>&, const Goal&, Team&);
template Convergence nsgs(BodySystem<2>&, const Goal&, Team&);
template Convergence nsgs(BodySystem<3>&, const Goal&, Team&);

}  // namespace chute::contact
