#include "figure_rows.hpp"

using namespace chute;
using namespace chute::test;

namespace figures_chapter_3_tests {

namespace {

double slope(const Points& p, double low, double high) {
  return std::log((1 - p.at(high)) / (1 - p.at(low))) / std::log(high / low);
}

}  // namespace

TEST_CASE("fig-3-01 goes as v^0, v^(-1/5), v^(1/5) in the elastic limit") {
  const Rows rows("fig-3-01");
  WARN("slopes of 1 - e_n: " << slope(rows("spring-dashpot"), 1, 10) << ", "
                             << slope(rows("hertz-linear-damping"), 50, 99) << ", "
                             << slope(rows("hertz-kuwabara-kono"), 0.0101, 0.02));
  CHECK(slope(rows("spring-dashpot"), 1, 10) == Approx(0).margin(1e-3));
  CHECK(slope(rows("hertz-linear-damping"), 50, 99) == Approx(-0.2).margin(0.01));
  CHECK(slope(rows("hertz-kuwabara-kono"), 0.0101, 0.02) == Approx(0.2).margin(0.015));
  CHECK(slope(rows("hertz-linear-damping fit"), 1, 10) == Approx(-0.2).margin(2e-3));
  CHECK(slope(rows("hertz-kuwabara-kono fit"), 1, 10) == Approx(0.2).margin(2e-3));
  CHECK(rows("spring-dashpot").at(1) == Approx(0.87).margin(1e-3));
  CHECK(rows("hertz-linear-damping").at(1) == Approx(0.87).margin(0.015));
  for (const double v : {60.0, 90.0})
    CHECK(rows("hertz-linear-damping").at(v) == Approx(rows("hertz-linear-damping fit").at(v)).margin(1e-3));
  for (const double v : {0.011, 0.02})
    CHECK(rows("hertz-kuwabara-kono").at(v) == Approx(rows("hertz-kuwabara-kono fit").at(v)).margin(1e-3));
}

TEST_CASE("fig-3-02 shows a jump at the first contact and attraction at the end") {
  const Rows rows("fig-3-02");
  for (const char* panel : {"a", "b"}) {
    double jump = 0;
    for (const char* series : {"e_n=0.95", "e_n=0.6", "e_n=0.2"}) {
      const auto& p = rows(series, panel);
      INFO(panel << " " << series << ": first " << p.y.front() << ", last " << p.y.back());
      CHECK(p.y.front() > std::max(0.02, jump));
      jump = p.y.front();
      CHECK(p.y.back() < 0);
      CHECK(*std::max_element(p.y.begin(), p.y.end()) == Approx(1).epsilon(1e-4));
    }
    CHECK(jump > 0.94);  // "the maximum force can even be achieved right at the beginning"
  }
}

TEST_CASE("fig-3-03 agrees with (3.8)") {
  const Rows rows("fig-3-03");
  double worst = 0;
  for (std::size_t k = 0; k < rows("simulation").x.size(); ++k)
    worst = std::max(worst, std::abs(rows("simulation").y[k] - rows("eq 3.8").y[k]));
  WARN("largest deviation " << worst);
  CHECK(worst < 1e-4);
}

TEST_CASE("fig-3-04 shows what each tangential law can do") {
  const Rows rows("fig-3-04");
  for (const char* mu : {"mu=0.15", "mu=0.25", "mu=0.35"})
    for (const double y : rows(mu, "a").y) CHECK(y > -1e-4);  // but for the shaking of the last step
  CHECK(rows("mu=0.15", "a").at(0.9) < 1e-3);  // rolling, then slope 1; the longer the higher μ is
  CHECK(rows("mu=0.15", "a").at(1.2) > 0.2);
  CHECK(rows("mu=0.35", "a").at(2) < 1e-3);
  CHECK(rows("mu=0.35", "a").at(6) - rows("mu=0.35", "a").at(5) == Approx(1).epsilon(1e-3));
  // b: e_s = exp(−7/2 γ_s t_n / m_eff)
  const double t_n = 9.99852e-6;
  for (const auto& [name, gamma] : {std::pair{"gamma_s=1", 1.0}, {"gamma_s=3", 3.0}, {"gamma_s=20", 20.0}}) {
    const auto& p = rows(name, "b");
    for (std::size_t k = 1; k < p.x.size(); ++k)
      CHECK(p.y[k] / p.x[k] == Approx(std::exp(-3.5 * gamma * t_n / 7.4e-5)).margin(1e-4));
  }
  // c: between b and a; with γ_s = 20 close to a
  for (const double psi : {0.5, 1.5, 3.0, 7.0})
    CHECK(rows("gamma_s=20", "c").at(psi) == Approx(rows("mu=0.25", "a").at(psi)).margin(0.02));
  CHECK(rows("gamma_s=1", "c").at(3) > rows("gamma_s=1", "b").at(3));
  // d, e: negative for small ψ_i, until about 1.6
  for (const auto& [panel, series] : {std::pair{"d", "k_s/k_n=1"},
                                      {"d", "k_s/k_n=2/7"},
                                      {"d", "k_s/k_n=1/5"},
                                      {"e", "k_s/k_n=1"},
                                      {"e", "k_s/k_n=2/3"},
                                      {"e", "k_s/k_n=1/3"}}) {
    WARN(panel << " " << series << ": negative until psi_i = " << rows(series, panel).zero());
    CHECK(rows(series, panel).zero() == Approx(1.62).margin(0.05));
    CHECK(rows(series, panel).at(1) < -0.3);
  }
  const auto& middle = rows("k_s/k_n=2/7", "d");  // constant e_s while it sticks
  CHECK(middle.at(0.2) / 0.2 == Approx(middle.at(0.4) / 0.4).epsilon(0.02));
  CHECK(rows("k_s/k_n=1", "d").at(0.2) > 0.05);  // the "slight rise" before it falls below
  // f: negative for small ψ_i, but less far
  CHECK(rows("zeta_0=1e-8", "f").at(0.4) < -0.2);
  CHECK(rows("zeta_0=1e-8", "f").zero() < 1.0);
}

TEST_CASE("fig-3-05 is e_n at 0 and goes to 1 at grazing, except for the viscous law") {
  const Rows rows("fig-3-05");
  for (const auto& [panel, series] : rows.names()) {
    const auto& p = rows(series, panel);
    INFO(panel << " " << series << ": " << p.y.front() << " … " << p.y.back());
    CHECK(p.y.front() == Approx(0.87).margin(1e-3));
    if (panel == "b")
      CHECK(p.y.back() < 0.92);
    else
      CHECK(p.y.back() > 0.99);
  }
}

TEST_CASE("fig-3-06 has curves that differ, and fig-3-07 nearly the same ones while the contact sticks") {
  const Rows linear("fig-3-06"), scaled("fig-3-07");
  const auto spread = [](const Rows& rows, double psi) {
    double low = INFINITY, high = -INFINITY;
    for (const char* v : {"v=0.1", "v=1", "v=15"})
      low = std::min(low, rows(v).at(psi)), high = std::max(high, rows(v).at(psi));
    return high - low;
  };
  for (const double psi : {0.2, 0.4, 0.6, 0.8, 1.2, 2.0, 8.0})
    WARN("psi_i " << psi << ": spread " << spread(linear, psi) << " in 3.6, " << spread(scaled, psi)
                  << " in 3.7");
  CHECK(spread(linear, 0.8) > 0.5);
  for (const double psi : {0.2, 0.4, 0.6, 0.8}) CHECK(spread(scaled, psi) < 0.15);
  CHECK(spread(scaled, 0.8) < 0.2 * spread(linear, 0.8));
  // sliding, both depend on v through e_n and, at 15 m/s, through the turning of the line of centres
  CHECK(spread(scaled, 8) > 0.3);
  CHECK(scaled("v=1 k_s/k_n=1/5").at(0.8) > scaled("v=1").at(0.8) + 0.1);
}

TEST_CASE("fig-3-08 depends on the velocity at small angles") {
  const Rows rows("fig-3-08");
  CHECK(rows("v=0.1").at(0.1) > rows("v=1").at(0.1) + 0.04);
  CHECK(rows("v=1").at(0.1) > rows("v=15").at(0.1) + 0.08);
  for (const char* v : {"v=0.1", "v=1", "v=15"}) CHECK(rows(v).y.back() > 0.98);
}

TEST_CASE(
    "fig-3-10 shows the viscous law and the capped spring find the new force, the uncapped spring not") {
  const Rows rows("fig-3-10");
  const double end = rows("F_s^p", "a").x.back();
  CHECK(rows("F_s^p", "a").at(0.019) == Approx(1.0 / 3).epsilon(1e-4));
  CHECK(rows("F_s^p", "a").at(end) == Approx(2.0 / 15).epsilon(1e-4));
  const auto& stuck = rows("F_s^p", "b");
  for (std::size_t k = 0; k < stuck.x.size(); ++k)
    if (stuck.x[k] > 0.03) CHECK(stuck.y[k] == Approx(0.275).epsilon(1e-3));
  for (const char* panel : {"a", "b", "c", "d"})
    CHECK(rows("F_s^b", panel).at(end) == Approx(0.1).epsilon(1e-6));
  CHECK(rows("F_s^p", "d").at(0.019) == Approx(1.0 / 3).epsilon(1e-6));
  CHECK(rows("F_s^p", "d").at(end) == Approx(2.0 / 15).epsilon(1e-6));
}

TEST_CASE("table-3-1 has the steady state: a to 5 digits, b wrong after the change, c right in the mean") {
  const Rows rows("table-3-1");
  for (const char* panel : {"0.8", "0.2"})
    for (std::size_t q = 0; q < 4; ++q) {
      const double exact = rows("theory", panel).y[q];
      CHECK(rows("a", panel).y[q] == Approx(exact).epsilon(1e-6).margin(1e-9));
      CHECK(std::isnan(rows("a", panel).y_err[q]));
      CHECK(rows("c", panel).y[q] == Approx(exact).epsilon(2e-3).margin(1e-5));
      CHECK(rows("contact", panel).y[q] == Approx(exact).epsilon(1e-6).margin(1e-6));
    }
  const double printed[] = {0.275, 0.1, -0.075, 0.35};  // the thesis's column (b) at F_p = 0.2
  for (std::size_t q = 0; q < 4; ++q) {
    CHECK(rows("b", "0.8").y[q] == Approx(rows("theory", "0.8").y[q]).epsilon(1e-4).margin(1e-5));
    CHECK(rows("b", "0.2").y[q] == Approx(printed[q]).epsilon(1e-6));
  }
  WARN("c at F_p = 0.2: F_s^p " << rows("c", "0.2").y[0] << " ± " << rows("c", "0.2").y_err[0]);
  CHECK(rows("c", "0.2").y_err[0] == Approx(0.275 - 2.0 / 15).epsilon(1e-3));  // rings from where it slid
  CHECK(rows("c", "0.8").y_err[0] < 1e-5);
}

}  // namespace figures_chapter_3_tests
