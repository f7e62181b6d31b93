// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Fill-in and factorisation time of saddle-point systems while the active set
// changes, by the ordering that MUMPS is given, on two elastic blocks with
// meshes that do not match.
//
//     fill_in DIMENSION COARSE REFINEMENTS [mortar]
//
// Active are a fourth, then a half, three fourths, all and again three fourths
// of the rows, those of the lowest numbers. Ways:
//
//   present   pattern of the active rows, ordered anew for each set
//   candidates  pattern of all rows, ordered once; open rows are lines of the
//             unit matrix with zeros where they may couple
//   inserted  pattern of the active rows; K is ordered once, and each active
//   row
//             comes after the last of its unknowns: no unknown of K moves
//   inserted candidates  the same with the pattern of all rows, analysed once
//
// Times are of the processor, in seconds; entries are those of the factors, in
// millions.
#include "../solve/two_blocks.h"

#include <dmumps_c.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <map>
#include <numeric>

using namespace abut;
using namespace abut::tests;

namespace
{
  double now()
  {
    return double(std::clock()) / CLOCKS_PER_SEC;
  }

  /** A matrix by lines and columns from 1, as MUMPS has it. */
  struct Triplets
  {
    int n = 0;
    std::vector<int> row, column;
    std::vector<double> value;

    void add(const int i, const int j, const double v)
    {
      row.push_back(i + 1);
      column.push_back(j + 1);
      value.push_back(v);
    }
  };

  class Mumps
  {
  public:
    Mumps()
    {
      data_.par = 1;
      data_.sym = 0;
      data_.comm_fortran = -987654; // the world
      call(-1);
      for (int k = 0; k < 4; ++k)
        data_.icntl[k] = k == 3 ? 1 : -1;
      data_.icntl[13] = 100;
    }

    ~Mumps()
    {
      data_.job = -2;
      dmumps_c(&data_);
    }

    /** @p order places in the elimination, from 1; null: by MUMPS. */
    void analyse(Triplets &matrix, std::vector<int> *order)
    {
      data_.n = matrix.n;
      data_.nnz = static_cast<MUMPS_INT8>(matrix.row.size());
      data_.irn = matrix.row.data();
      data_.jcn = matrix.column.data();
      data_.a = matrix.value.data();
      // No permutation to a better diagonal: it would be another ordering.
      data_.icntl[5] = order != nullptr ? 0 : 7;
      data_.icntl[6] = order != nullptr ? 1 : 7;
      data_.perm_in = order != nullptr ? order->data() : nullptr;
      call(1);
    }

    void factorise(Triplets &matrix)
    {
      // The same places, in arrays of another matrix.
      data_.irn = matrix.row.data();
      data_.jcn = matrix.column.data();
      data_.a = matrix.value.data();
      call(2);
    }

    double millions() const
    {
      const double entries = data_.infog[28];
      return entries < 0 ? -entries : entries / 1e6;
    }

    /** Place in the elimination by unknown, from 1. */
    std::vector<int> order() const
    {
      return {data_.sym_perm, data_.sym_perm + data_.n};
    }

  private:
    void call(const int job)
    {
      data_.job = job;
      dmumps_c(&data_);
      if (data_.infog[0] < 0)
        throw std::runtime_error("MUMPS: " + std::to_string(data_.infog[0]));
    }

    DMUMPS_STRUC_C data_ = {};
  };

  /** K, and what couples it with the first rows; with all of them zeros for
   * those that are open. */
  template <int dim>
  Triplets system(const TwoBlocks<dim> &blocks, const int n_active,
                  const bool all)
  {
    Triplets result;
    const la::LocalRows k = la::local_rows(blocks.stiffness);
    const int n = k.n_rows;
    for (int i = 0; i < n; ++i)
      for (int e = k.start[i]; e < k.start[i + 1]; ++e)
        result.add(i, k.column[e], k.value[e]);
    const solve::PointOperator &rows = blocks.operation;
    const int n_rows = all ? rows.n_rows() : n_active;
    result.n = n + n_rows;
    for (int i = 0; i < n_rows; ++i)
    {
      const bool is_active = i < n_active;
      result.add(n + i, n + i, is_active ? 0. : 1.);
      for (auto e = rows.begin(i); e < rows.end(i); ++e)
      {
        const double b = is_active ? rows.weight(i) * rows.coefficient(e) : 0.;
        result.add(n + i, rows.column(e), b);
        result.add(rows.column(e), n + i, b);
      }
    }
    return result;
  }

  /** The order of K with each row behind its last unknown. */
  template <int dim>
  std::vector<int> inserted(const TwoBlocks<dim> &blocks,
                            const std::vector<int> &of_k, const int n_rows)
  {
    const solve::PointOperator &rows = blocks.operation;
    std::vector<std::pair<double, int>> keys;
    for (int i = 0; i < int(of_k.size()); ++i)
      keys.emplace_back(of_k[i], i);
    for (int i = 0; i < n_rows; ++i)
    {
      int last = 0;
      for (auto e = rows.begin(i); e < rows.end(i); ++e)
        last = std::max(last, of_k[rows.column(e)]);
      keys.emplace_back(last + 0.5, int(of_k.size()) + i);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<int> order(keys.size());
    for (int place = 0; place < int(keys.size()); ++place)
      order[keys[place].second] = place + 1;
    return order;
  }

  struct Row
  {
    double analyses = 0., factorisations = 0., entries = 0.;
  };

  void print(const char *way, const Row &row)
  {
    std::printf("%-20s analysis %7.3f  factorisation %7.3f  sum %7.3f  "
                "entries %8.3f\n",
                way, row.analyses, row.factorisations,
                row.analyses + row.factorisations, row.entries);
  }

  template <int dim> void run(const TwoBlocksOptions &options)
  {
    const TwoBlocks<dim> blocks(MPI_COMM_SELF, options);
    const int n_rows = blocks.operation.n_rows();
    std::printf("%d unknowns, %d rows\n", int(blocks.n_dofs()), n_rows);
    const int sets[] = {n_rows / 4, n_rows / 2, 3 * n_rows / 4, n_rows,
                        3 * n_rows / 4};
    Triplets alone = system(blocks, 0, false);
    std::vector<int> of_k;
    {
      Mumps mumps;
      Row row;
      double start = now();
      mumps.analyse(alone, nullptr);
      row.analyses = now() - start;
      of_k = mumps.order();
      start = now();
      mumps.factorise(alone);
      row.factorisations = now() - start;
      row.entries = mumps.millions();
      print("K alone, once", row);
    }
    for (const std::string way :
         {"present", "candidates", "inserted", "inserted candidates"})
    {
      const bool all = way.find("candidates") != std::string::npos;
      const bool insert = way.find("inserted") != std::string::npos;
      Row row;
      std::unique_ptr<Mumps> mumps;
      for (const int n_active : sets)
      {
        Triplets matrix = system(blocks, n_active, all);
        double start = now();
        if (!mumps || !all)
        {
          mumps = std::make_unique<Mumps>();
          std::vector<int> order;
          if (insert)
            order = inserted(blocks, of_k, all ? n_rows : n_active);
          mumps->analyse(matrix, insert ? &order : nullptr);
        }
        row.analyses += now() - start;
        start = now();
        mumps->factorise(matrix);
        row.factorisations += now() - start;
        row.entries += mumps->millions() / std::size(sets);
      }
      print(way.c_str(), row);
    }
  }
} // namespace

int
main(int argc, char **argv)
try
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 4)
  {
    std::fprintf(stderr, "fill_in DIMENSION COARSE REFINEMENTS [mortar]\n");
    return 2;
  }
  TwoBlocksOptions options;
  options.n_lower = std::stoi(argv[2]);
  options.n_upper = options.n_lower * 3 / 2;
  options.refinements = std::stoi(argv[3]);
  if (argc > 4)
    options.discretisation = ABUT_DISCRETISATION_MORTAR;
  if (std::string(argv[1]) == "2")
    run<2>(options);
  else
    run<3>(options);
  return 0;
}
catch (const std::exception &error)
{
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
