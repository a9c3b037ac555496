#include "scene/material_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace chute::scene {

std::vector<double> shares_of(const std::vector<MaterialSpec>& materials) {
  std::vector<double> shares;
  for (const auto& material : materials) shares.push_back(material.share.value_or(0));
  if (!shares.empty() && std::ranges::none_of(materials, [](const auto& m) { return m.share.has_value(); }))
    shares.front() = 1;
  return shares;
}

bool all_have_diameters(const std::vector<MaterialSpec>& materials) {
  const auto shares = shares_of(materials);
  bool any = false;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    if (shares[k] > 0 && !materials[k].diameter) return false;
    any = any || shares[k] > 0;
  }
  return any;
}

std::vector<int> draw_materials(const std::vector<MaterialSpec>& materials, std::size_t count,
                                std::uint64_t seed) {
  // Whole numbers that add up: each material ends where the sum of the shares so far does.
  std::vector<int> of;
  double sum = 0;
  const auto shares = shares_of(materials);
  for (std::size_t k = 0; k < shares.size(); ++k) {
    sum += shares[k];
    const auto end = static_cast<std::size_t>(std::llround(std::min(1.0, sum) * static_cast<double>(count)));
    of.resize(std::max(of.size(), end), static_cast<int>(k));
  }
  const auto last =
      std::ranges::find_if(shares.rbegin(), shares.rend(), [](double share) { return share > 0; });
  of.resize(count, static_cast<int>(shares.rend() - last) - 1);
  Random random(seed, Purpose::sizes, 0, 1);  // step 0 are the sizes
  for (std::size_t k = count; k > 1; --k)
    std::swap(of[k - 1], of[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
  return of;
}

std::optional<int> number_of(const std::vector<MaterialSpec>& materials, const std::string& name) {
  const auto found = std::ranges::find(materials, name, &MaterialSpec::name);
  if (found == materials.end()) return {};
  return static_cast<int>(found - materials.begin());
}

std::optional<Refusal> misfit(const std::vector<MaterialSpec>& materials, bool brought) {
  constexpr double rounding = 1e-6;  // of shares that were written with few digits: thirds as 0.333333
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const auto& material = materials[k];
    const auto refuse = [&](const char* key, const std::string& what) {
      return Refusal{fmt::format("material[{}].{}", k, key), what};
    };
    if (material.name.empty()) return refuse("name", "is empty");
    if (material.name.find_first_of(" \t\r\n,;\"'#:|") != std::string::npos)
      return refuse("name", fmt::format("\"{}\": columns of tables are called by it: no blanks or signs",
                                        material.name));
    if (*number_of(materials, material.name) != static_cast<int>(k))
      return refuse("name", fmt::format("\"{}\" is the name of two materials", material.name));
    if (brought && material.share)
      return refuse("share", "the grains come with their materials from grains.start.from");
    if (brought && material.diameter)
      return refuse("diameter", "the grains come with their sizes from grains.start.from");
    if (!brought && material.diameter && shares_of(materials)[k] == 0)
      return refuse("diameter", "no grain is of this material: give it a share, too");
  }
  const auto shares = shares_of(materials);
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  if (!materials.empty() && std::abs(sum - 1) > rounding) {
    std::size_t k = materials.size() - 1;
    while (k > 0 && !materials[k].share) --k;
    return Refusal{fmt::format("material[{}].share", k),
                   fmt::format("all shares together are {:.6g}, must be 1", sum)};
  }
  return {};
}

}  // namespace chute::scene
