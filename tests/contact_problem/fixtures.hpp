#pragma once
#include <filesystem>
#include <string>

#include "engines/contact/solver/problem.hpp"

namespace chute::contact::test {

enum class Storage { dense, blocks, columns, triplets };

/// A problem as a text file of Siconos's; `sparse_origin`: with the number that newer ones put before a sparse matrix.
template <int D>
std::string siconos_text(const Problem<D>& problem, Storage storage, bool sparse_origin = false);

enum class Form { triplets, columns, rows };

/// A problem as an FCLIB file with W, q and μ.
template <int D>
void write_fclib_local(const std::filesystem::path& path, const Problem<D>& problem, Form form);

/// A matrix by its rows.
using Dense = std::vector<std::vector<double>>;

/// An FCLIB file with M, H, f, w and μ.
struct Global {
  int dimensions;
  Dense m, h;
  std::vector<double> f, w, mu;
};
void write_fclib_global(const std::filesystem::path& path, const Global& global, Form form);

/// All of W, zeros too.
template <int D>
Dense dense(const Problem<D>& problem);

}  // namespace chute::contact::test
