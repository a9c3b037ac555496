#include "fixtures.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <stdexcept>

namespace chute::contact::test {
namespace {

hid_t need(hid_t id) {
  if (id < 0) throw std::runtime_error("HDF5 refuses a fixture");
  return id;
}

template <class T>
void put(hid_t file, const std::string& key, hid_t type, const std::vector<T>& values) {
  const hsize_t size = values.size();
  const auto links = need(H5Pcreate(H5P_LINK_CREATE));
  H5Pset_create_intermediate_group(links, 1);
  const auto space = need(H5Screate_simple(1, &size, nullptr));
  const auto set = need(H5Dcreate2(file, key.c_str(), type, space, links, H5P_DEFAULT, H5P_DEFAULT));
  if (H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    throw std::runtime_error("HDF5 refuses a fixture's values");
  H5Dclose(set), H5Sclose(space), H5Pclose(links);
}
void put(hid_t file, const std::string& key, const std::vector<double>& x) {
  put(file, key, H5T_NATIVE_DOUBLE, x);
}
void put(hid_t file, const std::string& key, const std::vector<int>& x) { put(file, key, H5T_NATIVE_INT, x); }

void put_matrix(hid_t file, const std::string& key, const Dense& matrix, Form form) {
  const int rows = static_cast<int>(matrix.size()), columns = static_cast<int>(matrix[0].size());
  std::vector<int> p, i;
  std::vector<double> x;
  const bool by_columns = form == Form::columns;
  const int lines = by_columns ? columns : rows, across = by_columns ? rows : columns;
  if (form != Form::triplets) p.push_back(0);
  for (int line = 0; line < lines; ++line) {
    for (int k = 0; k < across; ++k) {
      const int row = by_columns ? k : line, column = by_columns ? line : k;
      const double value = matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      if (value == 0) continue;
      if (form == Form::triplets) p.push_back(column);
      i.push_back(form == Form::triplets ? row : k);
      x.push_back(value);
    }
    if (form != Form::triplets) p.push_back(static_cast<int>(x.size()));
  }
  const int filled = static_cast<int>(x.size());
  put(file, key + "/m", std::vector<int>{rows});
  put(file, key + "/n", std::vector<int>{columns});
  put(file, key + "/nzmax", std::vector<int>{filled});
  put(file, key + "/nz", std::vector<int>{form == Form::triplets ? filled : by_columns ? -1 : -2});
  put(file, key + "/p", p);
  put(file, key + "/i", i);
  put(file, key + "/x", x);
}

template <int D>
std::vector<double> flat(const std::vector<Vec<D>>& q) {
  std::vector<double> all;
  for (const auto& v : q) all.insert(all.end(), v.c.begin(), v.c.end());
  return all;
}

}  // namespace

template <int D>
Dense dense(const Problem<D>& problem) {
  Dense w(problem.size() * D, std::vector<double>(problem.size() * D));
  for (std::size_t i = 0; i < problem.size(); ++i)
    for (auto b = problem.row_starts[i]; b < problem.row_starts[i + 1]; ++b)
      for (std::size_t k = 0; k < D; ++k)
        for (std::size_t l = 0; l < D; ++l)
          w[i * D + k][problem.columns[b] * D + l] = problem.blocks[b].c[k * D + l];
  return w;
}

template <int D>
std::string siconos_text(const Problem<D>& problem, Storage storage, bool sparse_origin) {
  const auto m = problem.size(), n = m * D;
  const auto w = dense(problem);
  std::string text = fmt::format("{}\n{}\n{}\n{}\n{}\n", D, m,
                                 storage == Storage::dense    ? 0
                                 : storage == Storage::blocks ? 1
                                                              : 2,
                                 n, n);
  std::size_t filled = 0;
  for (const auto& row : w)
    for (const double x : row) filled += x != 0;
  if (storage == Storage::dense) {
    text += fmt::format("{}\t{}\n", n, n);
    for (const auto& row : w) {
      for (const double x : row) text += fmt::format("{:32.24e} ", x);
      text += '\n';
    }
  } else if (storage == Storage::blocks) {
    text += fmt::format("{}\n{}\n{}\n", problem.blocks.size(), m, m);
    for (int side = 0; side < 2; ++side) {
      for (std::size_t i = 1; i <= m; ++i) text += fmt::format("{}\t", i * D);
      text += '\n';
    }
    text += fmt::format("{}\n{}\n", m + 1, problem.blocks.size());
    for (const auto start : problem.row_starts) text += fmt::format("{}\t", start);
    text += '\n';
    for (const auto column : problem.columns) text += fmt::format("{}\t", column);
    text += '\n';
    for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
      text += fmt::format("{}\n", b);
      for (int column = 0; column < D; ++column)
        for (int row = 0; row < D; ++row) text += fmt::format("{:32.24e}\n", problem.blocks[b](row, column));
    }
  } else {
    if (sparse_origin) text += "1\n";
    text += "CSparse Version 4.0.2, Sept 20, 2017.  Copyright (c) Timothy A. Davis, 2006-2016\n";
    if (storage == Storage::triplets) {
      text += fmt::format("triplet: {0}-by-{0}, nzmax: {1} nnz: {1}\n", n, filled);
      for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column)
          if (w[row][column] != 0) text += fmt::format("    {} {} : {:.17g}\n", row, column, w[row][column]);
    } else {
      text += fmt::format("{0}-by-{0}, nzmax: {1} nnz: {1}, 1-norm: 3.25\n", n, filled);
      std::size_t done = 0;
      for (std::size_t column = 0; column < n; ++column) {
        std::string lines;
        const auto first = done;
        for (std::size_t row = 0; row < n; ++row)
          if (w[row][column] != 0) {
            lines += fmt::format("      {} : {:.17g}\n", row, w[row][column]);
            ++done;
          }
        text += fmt::format("    col {} : locations {} to {}\n{}", column, first, static_cast<long>(done) - 1,
                            lines);
      }
    }
  }
  for (const double x : flat<D>(problem.q)) text += fmt::format("{:32.24e} ", x);
  text += '\n';
  for (const double x : problem.friction) text += fmt::format("{:32.24e} ", x);
  text += D == 2 ? "\n1\n" : "\n";
  return text;
}

template <int D>
void write_fclib_local(const std::filesystem::path& path, const Problem<D>& problem, Form form) {
  const auto file = need(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  put(file, "/fclib_local/spacedim", std::vector<int>{D});
  put_matrix(file, "/fclib_local/W", dense(problem), form);
  put(file, "/fclib_local/vectors/q", flat<D>(problem.q));
  put(file, "/fclib_local/vectors/mu", problem.friction);
  H5Fclose(file);
}

void write_fclib_global(const std::filesystem::path& path, const Global& global, Form form) {
  const auto file = need(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  put(file, "/fclib_global/spacedim", std::vector<int>{global.dimensions});
  put_matrix(file, "/fclib_global/M", global.m, form);
  put_matrix(file, "/fclib_global/H", global.h, form);
  put(file, "/fclib_global/vectors/f", global.f);
  put(file, "/fclib_global/vectors/w", global.w);
  put(file, "/fclib_global/vectors/mu", global.mu);
  H5Fclose(file);
}

template Dense dense(const Problem<2>&);
template Dense dense(const Problem<3>&);
template std::string siconos_text(const Problem<2>&, Storage, bool);
template std::string siconos_text(const Problem<3>&, Storage, bool);
template void write_fclib_local(const std::filesystem::path&, const Problem<2>&, Form);
template void write_fclib_local(const std::filesystem::path&, const Problem<3>&, Form);

}  // namespace chute::contact::test
