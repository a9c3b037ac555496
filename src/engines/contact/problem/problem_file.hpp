#pragma once
#include <filesystem>
#include <variant>

#include "engines/contact/solver/problem.hpp"

namespace chute::contact {

using AnyProblem = std::variant<Problem<2>, Problem<3>>;

/// Reads a problem of frictional contact: HDF5 files in FCLIB's format (fclib_local: W, q, μ; fclib_global:
/// M, H, f, w and μ, so that W = HᵀM⁻¹H and q = w + HᵀM⁻¹f), told by their first bytes, and else the text files of
/// Siconos (W dense, in blocks or sparse). InputError, one line, if the file is not one.
AnyProblem read_problem(const std::filesystem::path& path);

}  // namespace chute::contact
