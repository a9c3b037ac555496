#include "engines/contact/problem/problem_file.hpp"

#include <fmt/format.h>

#include "common/atomic_file.hpp"
#include "common/error.hpp"
#include "engines/contact/problem/parts.hpp"

namespace chute::contact {
namespace {

template <int D>
Problem<D> put_together(Parts parts, const std::string& name) {
  std::vector<Vec<D>> q(parts.contacts);
  for (std::size_t i = 0; i < parts.q.size(); ++i) q[i / D][static_cast<int>(i % D)] = parts.q[i];
  auto problem = assemble<D>(parts.matrix, std::move(q), std::move(parts.friction));
  try {
    check(problem);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", name, error.what()));
  }
  return problem;
}

}  // namespace

AnyProblem read_problem(const std::filesystem::path& path) {
  const auto name = path.string();
  const auto content = read_file(path);
  const bool hdf5 = content.starts_with("\x89HDF\r\n\x1a\n");
  auto parts = hdf5 ? read_fclib(path) : read_siconos_text(content, name);
  if (parts.dimensions == 2) return put_together<2>(std::move(parts), name);
  return put_together<3>(std::move(parts), name);
}

}  // namespace chute::contact
