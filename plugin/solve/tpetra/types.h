// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_TPETRA_TYPES_H
#define ABUT_SOLVE_TPETRA_TYPES_H

#include <abut/dealii/linear_algebra.h>

#include <Tpetra_MultiVector.hpp>

#include <type_traits>
#include <utility>

/** Trilinos' own types behind la::Matrix and la::Vector. */
namespace abut::solve::tpetra
{
  using Matrix =
      std::decay_t<decltype(std::declval<la::Matrix &>().trilinos_matrix())>;
  using Scalar = Matrix::scalar_type;
  using Local = Matrix::local_ordinal_type;
  using Global = Matrix::global_ordinal_type;
  using Node = Matrix::node_type;
  using Vectors = Tpetra::MultiVector<Scalar, Local, Global, Node>;
} // namespace abut::solve::tpetra

#endif
