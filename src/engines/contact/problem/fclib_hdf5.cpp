#include <fmt/format.h>
#include <hdf5.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>

#include "common/error.hpp"
#include "engines/contact/problem/parts.hpp"

namespace chute::contact {
namespace {

/// An identifier of HDF5's and how it is closed.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

class File {
 public:
  explicit File(const std::filesystem::path& path)
      : name_(path.string()), file_(H5Fopen(name_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (file_ < 0) throw InputError(name_ + ": not a whole HDF5 file");
    bytes_ = std::filesystem::file_size(path);
  }

  [[noreturn]] void complain(const std::string& key, const std::string& what) const {
    throw InputError(fmt::format("{}: {}: {}", name_, key, what));
  }
  bool has(const std::string& key) const { return H5Lexists(file_, key.c_str(), H5P_DEFAULT) > 0; }

  std::vector<double> numbers(const std::string& key) const {
    auto values = read<double>(key, H5T_NATIVE_DOUBLE);
    for (const double x : values)
      if (!std::isfinite(x)) complain(key, "has a number that is not finite");
    return values;
  }
  std::vector<double> numbers(const std::string& key, std::size_t count) const {
    auto values = numbers(key);
    if (values.size() != count)
      complain(key, fmt::format("must have {} numbers, not {}", count, values.size()));
    return values;
  }
  std::vector<long long> integers(const std::string& key) const {
    return read<long long>(key, H5T_NATIVE_LLONG);
  }
  long long integer(const std::string& key, long long least, long long most) const {
    const auto values = integers(key);
    if (values.size() != 1) complain(key, fmt::format("must be one number, not {}", values.size()));
    if (values[0] < least || values[0] > most)
      complain(key, fmt::format("must be from {} to {}, not {}", least, most, values[0]));
    return values[0];
  }

 private:
  std::string name_;
  Handle file_;
  std::uintmax_t bytes_ = 0;

  template <class T>
  std::vector<T> read(const std::string& key, hid_t type) const {
    if (!has(key)) complain(key, "is missing");
    const Handle set(H5Dopen2(file_, key.c_str(), H5P_DEFAULT), H5Dclose);
    if (set < 0) complain(key, "must be a data set");
    const Handle space(H5Dget_space(set), H5Sclose), own(H5Dget_type(set), H5Tclose);
    const auto points = space < 0 ? -1 : H5Sget_simple_extent_npoints(space);
    const auto kind = own < 0 ? H5T_NO_CLASS : H5Tget_class(own);
    if (points < 0 || (kind != H5T_FLOAT && kind != H5T_INTEGER)) complain(key, "must hold numbers");
    // What a file claims to hold may be no more than what it can: packed, a number takes a hundredth at least.
    constexpr std::uintmax_t best_packing = 100;
    const auto stored = std::min<std::uintmax_t>(H5Dget_storage_size(set), bytes_);
    if (static_cast<std::uintmax_t>(points) > stored * best_packing / H5Tget_size(own))
      complain(key, fmt::format("is said to have {} numbers, which the file cannot hold", points));
    std::vector<T> values(static_cast<std::size_t>(points));
    if (points > 0 && H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      complain(key, "cannot be read");
    return values;
  }
};

struct Sparse {
  std::size_t rows, columns;
  std::vector<Entry> entries;
};

/// A matrix as CSparse keeps it: nz ≥ 0: triplets, −1: compressed columns, −2: compressed rows.
Sparse read_sparse(const File& file, const std::string& key) {
  constexpr long long most = std::numeric_limits<std::int32_t>::max();
  Sparse matrix;
  matrix.rows = static_cast<std::size_t>(file.integer(key + "/m", 1, most));
  matrix.columns = static_cast<std::size_t>(file.integer(key + "/n", 1, most));
  const auto nz = file.integer(key + "/nz", -2, most);
  const auto p = file.integers(key + "/p"), i = file.integers(key + "/i");
  const auto x = file.numbers(key + "/x");
  const auto index = [&](const char* what, long long value, std::size_t limit) {
    if (value < 0 || static_cast<std::size_t>(value) >= limit)
      file.complain(key + what, fmt::format("must be from 0 to {}, not {}", limit - 1, value));
    return static_cast<std::size_t>(value);
  };
  const auto enough = [&](const char* what, std::size_t has, std::size_t needs) {
    if (has < needs) file.complain(key + what, fmt::format("must have {} numbers, not {}", needs, has));
  };
  if (nz >= 0) {
    const auto filled = static_cast<std::size_t>(nz);
    enough("/i", i.size(), filled), enough("/p", p.size(), filled), enough("/x", x.size(), filled);
    for (std::size_t k = 0; k < filled; ++k)
      matrix.entries.push_back({index("/i", i[k], matrix.rows), index("/p", p[k], matrix.columns), x[k]});
    return matrix;
  }
  const bool by_columns = nz == -1;
  const auto lines = by_columns ? matrix.columns : matrix.rows;
  enough("/p", p.size(), lines + 1);
  if (p[0] != 0) file.complain(key + "/p", "must begin with 0");
  for (std::size_t line = 0; line < lines; ++line) {
    if (p[line + 1] < p[line]) file.complain(key + "/p", "must go up");
    const auto end = static_cast<std::size_t>(p[line + 1]);
    enough("/i", i.size(), end), enough("/x", x.size(), end);
    for (auto k = static_cast<std::size_t>(p[line]); k < end; ++k) {
      const auto other = index("/i", i[k], by_columns ? matrix.rows : matrix.columns);
      matrix.entries.push_back(by_columns ? Entry{other, line, x[k]} : Entry{line, other, x[k]});
    }
  }
  return matrix;
}

using Matrix = Eigen::SparseMatrix<double>;

Matrix to_eigen(const Sparse& sparse) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(sparse.entries.size());
  for (const auto& e : sparse.entries)
    triplets.emplace_back(static_cast<int>(e.row), static_cast<int>(e.column), e.value);
  Matrix matrix(static_cast<int>(sparse.rows), static_cast<int>(sparse.columns));
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  return matrix;
}

void read_size(const File& file, const std::string& group, Parts& parts, std::size_t columns) {
  parts.dimensions = static_cast<int>(file.integer(group + "/spacedim", 2, 3));
  const auto d = static_cast<std::size_t>(parts.dimensions);
  parts.friction = file.numbers(group + "/vectors/mu");
  parts.contacts = parts.friction.size();
  if (parts.contacts == 0 || parts.contacts > most_contacts)
    file.complain(group + "/vectors/mu", fmt::format("must have 1 to {} numbers", most_contacts));
  if (columns != d * parts.contacts)
    file.complain(group, fmt::format("{} contacts in {} dimensions need {} columns, not {}", parts.contacts,
                                     d, d * parts.contacts, columns));
}

Parts read_local(const File& file) {
  const std::string group = "/fclib_local";
  if (file.has(group + "/V") || file.has(group + "/R"))
    file.complain(group, "equality constraints are not supported");
  Parts parts;
  auto w = read_sparse(file, group + "/W");
  read_size(file, group, parts, w.columns);
  if (w.rows != w.columns)
    file.complain(group + "/W", fmt::format("must be square, not {} by {}", w.rows, w.columns));
  parts.matrix = std::move(w.entries);
  parts.q = file.numbers(group + "/vectors/q", w.rows);
  return parts;
}

/// W = HᵀM⁻¹H and q = w + HᵀM⁻¹f.
Parts read_global(const File& file) {
  const std::string group = "/fclib_global";
  if (file.has(group + "/G")) file.complain(group + "/G", "equality constraints are not supported");
  Parts parts;
  const auto masses = read_sparse(file, group + "/M"), directions = read_sparse(file, group + "/H");
  read_size(file, group, parts, directions.columns);
  if (masses.rows != masses.columns || masses.rows != directions.rows)
    file.complain(group, fmt::format("M must be square with H's rows, not {} by {} and {}", masses.rows,
                                     masses.columns, directions.rows));
  const auto f = file.numbers(group + "/vectors/f", masses.rows);
  const auto w = file.numbers(group + "/vectors/w", directions.columns);
  const Matrix m = to_eigen(masses), h = to_eigen(directions);
  constexpr double rounding = 1e-10;  // of the largest element: what a program's own M may be asymmetric by
  const Matrix transposed = m.transpose();
  const Eigen::SimplicialLDLT<Matrix> inverse(m);
  if ((m - transposed).norm() > rounding * m.norm() || inverse.info() != Eigen::Success ||
      !(inverse.vectorD().minCoeff() > 0))
    file.complain(group + "/M", "must be symmetric and positive definite");
  const Matrix accelerations = inverse.solve(h);
  // A body's contacts all feel each other: with many on one body W grows as their square.
  constexpr double most_elements = 2e8;
  Eigen::ArrayXd in_row = Eigen::ArrayXd::Zero(h.rows());
  const auto each = [](const Matrix& matrix, const auto& work) {
    for (int column = 0; column < matrix.outerSize(); ++column)
      for (Matrix::InnerIterator it(matrix, column); it; ++it) work(it);
  };
  double elements = 0;
  each(h, [&](const auto& it) { ++in_row[it.row()]; });
  each(accelerations, [&](const auto& it) { elements += in_row[it.row()]; });
  if (elements > most_elements)
    file.complain(group, fmt::format("W would have more than {} elements", most_elements));
  const Matrix delassus = Matrix(h.transpose()) * accelerations;
  each(delassus, [&](const auto& it) {
    parts.matrix.push_back(
        {static_cast<std::size_t>(it.row()), static_cast<std::size_t>(it.col()), it.value()});
  });
  const Eigen::VectorXd free =
      inverse.solve(Eigen::Map<const Eigen::VectorXd>(f.data(), static_cast<int>(f.size())));
  const Eigen::VectorXd q =
      Eigen::Map<const Eigen::VectorXd>(w.data(), static_cast<int>(w.size())) + h.transpose() * free;
  parts.q.assign(q.begin(), q.end());
  return parts;
}

}  // namespace

Parts read_fclib(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // errors are told once, by this program
  const File file(path);
  if (file.has("/fclib_local")) return read_local(file);
  if (file.has("/fclib_global")) return read_global(file);
  file.complain("/", "has neither fclib_local nor fclib_global");
}

}  // namespace chute::contact
